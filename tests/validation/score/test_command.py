"""`needle blind`: what it prints, writes and refuses."""

import json

import pytest

from scripts.main import main

LOGS = 7


def test_the_score_is_printed_and_kept(folder, tmp_path, capsys):
    assert main(["blind", "score", str(folder), "--out", str(tmp_path / "score")]) == 0
    printed = capsys.readouterr().out
    assert printed.index("confidently") < printed.index("Calibration")
    assert any(line.split()[:2] == ["all", str(LOGS)] for line in printed.splitlines())
    assert "calibration error of the probabilities" in printed
    lines = (tmp_path / "score" / "scores.csv").read_text().splitlines()
    assert len(lines) == LOGS + 1
    assert lines[0].startswith(
        "case,kind,truth,said,verdict,expected,exact,confidently_wrong,confused,open,signature"
    )
    summary = json.loads((tmp_path / "score" / "score.json").read_text())
    assert summary["logs"] == LOGS
    assert summary["missing"]["said"][1] == 1  # one log is from outside of the library
    assert summary["missing"]["elsewhere"] == [0, LOGS - 1]
    assert (tmp_path / "score" / "score.png").read_bytes()[:4] == b"\x89PNG"


def test_fewer_trials_are_scored_beside_the_reports_on_whole_logs(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    answers = json.loads((folder / "answers" / "answers.json").read_text())
    case = next(case for case, answer in answers.items() if answer["kind"] == "none")  # the cheapest
    single = folder.parent / "single"
    (single / "logs").mkdir(parents=True)
    (single / "logs" / case).symlink_to(folder / "logs" / case)
    (single / "answers").symlink_to(folder / "answers")
    assert main(["blind", "score", str(single), "--trials", "1"]) == 0
    report = json.loads((single / "reports_of_1" / f"{case}.json").read_text())
    whole = json.loads((folder / "reports" / f"{case}.json").read_text())
    assert report["gap"]["before"] != whole["gap"]["before"]
    assert not (single / "reports").exists()
    assert (tmp_path / "out" / "score" / "scores.csv").is_file()


def test_one_log_is_made_with_its_ground_truth_in_another_folder(tmp_path, capsys):
    out = tmp_path / "set"
    arguments = [
        "--seed",
        "5",
        "--count",
        "1",
        "--short",
        "--kinds",
        "single",
        "--effects",
        "torque_bias",
    ]
    assert main(["blind", "make", "--out", str(out), *arguments]) == 0
    assert [path.name for path in (out / "logs").iterdir()] == ["case_001"]
    answers = json.loads((out / "answers" / "answers.json").read_text())
    assert answers["case_001"]["effects"] == ["torque_bias"]


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["--count", "-3"], ["count: expected at least 1 log, found -3"]),
        (["--effects", "magnetism"], ["--effects: expected one of", "magnetism"]),
        (["--kinds", "double"], ["--kinds: expected one of all", "double"]),
        (["--kinds", "paar"], ["--kinds: expected a known name", "did you mean 'pair'?"]),
        (["--effects", "coulomb-frction"], ["did you mean 'coulomb_friction'?"]),
        (["--roughness", "outlier"], ["did you mean 'outliers'?"]),
        (["--signature", "2", "1"], ["signature: expected 0 < LOW < HIGH", "found 2 1"]),
    ],
)
def test_make_names_the_argument_that_it_refuses(tmp_path, capsys, arguments, parts):
    assert main(["blind", "make", "--out", str(tmp_path / "new"), *arguments]) == 2
    printed = " ".join(capsys.readouterr().err.split())
    assert all(part in printed for part in parts), printed
    assert not (tmp_path / "new").exists()


def test_make_refuses_a_folder_that_exists(tmp_path, capsys):
    assert main(["blind", "make", "--out", str(tmp_path)]) == 2
    assert "does not exist yet" in " ".join(capsys.readouterr().err.split())


@pytest.mark.parametrize("text", ["", "[]", "{}"])
def test_score_refuses_an_empty_ground_truth_before_it_diagnoses(tmp_path, capsys, text):
    (tmp_path / "logs" / "case_001").mkdir(parents=True)
    (tmp_path / "answers").mkdir()
    (tmp_path / "answers" / "answers.json").write_text(text)
    assert main(["blind", "score", str(tmp_path)]) == 2
    printed = " ".join(capsys.readouterr().err.split())
    assert "expected a JSON object with an entry per log" in printed
    assert "restore the file" in printed
    assert not (tmp_path / "reports").exists()


def test_score_asks_for_logs_answers_and_a_count_of_trials(tmp_path, capsys):
    assert main(["blind", "score", str(tmp_path)]) == 2
    assert "logs/ and answers/answers.json" in " ".join(capsys.readouterr().err.split())
    assert main(["blind", "score", str(tmp_path), "--trials", "0"]) == 2
    assert "trials: expected at least 1" in " ".join(capsys.readouterr().err.split())
