"""The diagnosis on rigs that it has never met: a short run of `needle blind`.

The long run, of 210 logs, is in docs/diagnosis.md. With nine of ten logs right, which is far
below what the long run measures, 32 logs have fewer than 25 right with a probability of 1.3 %.
"""

import json

import pytest

from benchmarks.blind.make import make_logs
from benchmarks.blind.run import diagnose_all
from benchmarks.blind.score import coverage, read_scores, summary
from scripts.main import main

LOGS = 32


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("blind") / "set"
    make_logs(folder, seed=11, count=LOGS, short=True, signature=(1.5, 20.0))
    diagnose_all(folder / "logs", folder / "reports")
    return folder


@pytest.fixture(scope="module")
def scores(folder):
    return read_scores(folder)


def test_most_rigs_are_told_exactly(scores):
    assert len(scores) == LOGS
    wrong = scores[~scores["exact"]][["truth", "said", "verdict"]]
    assert scores["exact"].sum() >= 25, wrong


def test_no_alarm_is_false(scores):
    none = scores[scores["kind"] == "none"]
    assert len(none) >= 2
    assert (none["verdict"] == "none").all()


def test_a_wrong_explanation_is_rarely_said_with_confidence(scores):
    wrong = (scores["verdict"] == "explained") & ~scores["exact"]
    assert wrong.sum() <= 2, scores[wrong][["truth", "said"]]


def test_intervals_cover(scores):
    """Of some 35 intervals of 95 %, fewer than 28 cover with a probability of 0.1 %."""
    share, count = coverage(scores)
    assert count >= 20
    assert share >= 0.8


def test_the_score_sees_a_wrong_answer(folder, scores, tmp_path):
    """Negative control: with the answers shifted by one log the score falls to nothing."""
    shifted = tmp_path / "set"
    (shifted / "answers").mkdir(parents=True)
    (shifted / "reports").symlink_to(folder / "reports")
    answers = json.loads((folder / "answers" / "answers.json").read_text())
    cases, values = list(answers), list(answers.values())
    moved = dict(zip(cases, [*values[1:], values[0]], strict=True))
    (shifted / "answers" / "answers.json").write_text(json.dumps(moved))
    assert read_scores(shifted)["exact"].mean() < 0.3 < summary(scores)["exact"].mean()


def test_the_score_is_printed_and_kept(folder, tmp_path, capsys):
    assert main(["blind", "score", str(folder), "--out", str(tmp_path / "score")]) == 0
    printed = capsys.readouterr().out
    assert "probabilities are off by" in printed
    assert (tmp_path / "score" / "scores.csv").read_text().count("\n") == LOGS + 1
    assert (tmp_path / "score" / "score.png").read_bytes()[:4] == b"\x89PNG"


def test_logs_and_answers_are_asked_for_by_name(tmp_path, capsys):
    assert main(["blind", "score", str(tmp_path)]) == 2
    assert "answers" in capsys.readouterr().err
    assert main(["blind", "make", "--out", str(tmp_path)]) == 2
    assert "does not exist yet" in capsys.readouterr().err
    out = str(tmp_path / "new")
    assert main(["blind", "make", "--out", out, "--effects", "magnetism"]) == 2
    assert "magnetism" in capsys.readouterr().err
