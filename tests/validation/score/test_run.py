"""Diagnosing a folder of logs: reports that exist are kept, logs that cannot be read are refused."""

import json
from types import SimpleNamespace

import pandas as pd
import pytest
from rich.console import Console

from diagnosis.engines.engine import EngineFailed
from models.errors import InvalidValue, UnsafeOutput
from scripts import blind
from validation.score import run
from validation.score.run import diagnose_all, score_logs


@pytest.fixture
def unusable(tmp_path):
    """A folder with one log that lacks its rig.yaml."""
    (tmp_path / "logs" / "case_001").mkdir(parents=True)
    return tmp_path


def test_a_log_that_cannot_be_read_has_a_report_that_says_why(unusable):
    diagnose_all(unusable / "logs", unusable / "reports", workers=1)
    report = json.loads((unusable / "reports" / "case_001.json").read_text())
    assert (report["verdict"], report["effects"]) == ("refused", [])
    assert "rig.yaml" in report["why"]
    assert report["seconds"] >= 0


def test_the_answers_are_read_after_the_reports_are_written(unusable, monkeypatch):
    """The score checks them first, for a diagnosis takes long, but no answer reaches it."""
    order = []
    monkeypatch.setattr(run, "diagnose_all", lambda logs, reports, **how: order.append((logs, how)))
    monkeypatch.setattr(run, "read_answers", lambda folder: order.append("checked"))
    monkeypatch.setattr(run, "read_scores", lambda *given: order.append(("scored", *given)) or scores)
    monkeypatch.setattr(blind, "_print", lambda *given: None)
    monkeypatch.setattr(blind, "as_json", lambda scores: {})
    (unusable / "answers").mkdir()
    (unusable / "answers" / "answers.json").write_text("{}")
    scores = pd.DataFrame()
    out = unusable / "score"
    monkeypatch.setattr(blind.picture, "draw", lambda scores, path: path.write_text("a picture"))
    blind.run_score(unusable, out, trials=2, limit_s=9.0, force=False, console=Console())
    assert [order[0], order[2]] == ["checked", ("scored", unusable, 2, 9.0)]
    logs, how = order[1]
    assert logs == unusable / "logs"
    assert (how["trials"], how["limit_s"]) == (2, 9.0)


@pytest.mark.parametrize("limit_s", [None, 12.0])
def test_the_limit_of_a_log_reaches_its_diagnosis(tmp_path, monkeypatch, limit_s):
    given = {}
    log = SimpleNamespace(trials=[1, 2, 3])
    monkeypatch.setattr(run, "read_rig_log", lambda case: log)
    monkeypatch.setattr(run, "replace", lambda log, trials: trials)
    monkeypatch.setattr(run, "diagnose", lambda trials, **how: given.update(how, trials=trials))
    monkeypatch.setattr(run, "as_json", lambda found: {"verdict": "none"})
    report = run.report_of(2, limit_s, str(tmp_path / "case_001"))
    assert given.pop("trials") == [1, 2]
    assert given == {"workers": 1, **({"limit_s": limit_s} if limit_s else {})}
    assert report["verdict"] == "none"


def test_any_engine_may_diagnose_and_reports_are_written_as_they_come(unusable):
    """One that ends early leaves those that it gave; they are kept by the next."""
    (unusable / "logs" / "case_002").mkdir()

    def first_alone(job, cases):
        yield cases[0], job(cases[0])
        raise EngineFailed("nobody is left")

    with pytest.raises(EngineFailed):
        diagnose_all(unusable / "logs", unusable / "reports", engine=first_alone)
    written = unusable / "reports" / "case_001.json"
    before = written.read_text()
    assert json.loads(before)["verdict"] == "refused"
    seen = []
    diagnose_all(
        unusable / "logs", unusable / "reports", workers=1, progress=lambda *told: seen.append(told)
    )
    assert seen[-1] == ("diagnosing logs", 1, 1)
    assert written.read_text() == before
    assert (unusable / "reports" / "case_002.json").exists()


def test_a_log_whose_arithmetic_fails_is_recorded_and_does_not_stop_the_rest(unusable, monkeypatch):
    monkeypatch.setattr(run, "read_rig_log", lambda case: 1 / len(()))
    diagnose_all(unusable / "logs", unusable / "reports", workers=1)
    report = json.loads((unusable / "reports" / "case_001.json").read_text())
    assert (report["verdict"], report["why"]) == ("refused", "division by zero")


def test_a_report_that_exists_is_kept_and_tasks_can_be_watched(unusable):
    (unusable / "reports").mkdir()
    kept = unusable / "reports" / "case_001.json"
    kept.write_text("kept")
    seen = []
    diagnose_all(
        unusable / "logs", unusable / "reports", workers=1, progress=lambda *told: seen.append(told)
    )
    assert kept.read_text() == "kept"
    assert seen == [("diagnosing logs", 0, 0)]


def test_no_report_is_written_through_a_link(unusable, tmp_path):
    """The folder of reports may be a link to where something else lies."""
    (tmp_path / "mine").mkdir()
    (unusable / "reports").symlink_to(tmp_path / "mine")
    with pytest.raises(UnsafeOutput, match="a link"):
        diagnose_all(unusable / "logs", unusable / "reports", workers=1)
    assert list((tmp_path / "mine").iterdir()) == []


def test_reports_hold_no_ground_truth(folder):
    """The diagnosis is given a log's folder alone."""
    for path in (folder / "reports").iterdir():
        assert not {"kind", "signature", "answer"} & json.loads(path.read_text()).keys()


def test_unusable_ground_truth_is_seen_before_anything_is_diagnosed(unusable):
    (unusable / "answers").mkdir()
    (unusable / "answers" / "answers.json").write_text("{}")
    with pytest.raises(InvalidValue, match="answers.json"):
        score_logs(unusable)
    assert not (unusable / "reports").exists()


def test_logs_are_diagnosed_and_compared_in_one_call(folder, scores):
    """Reports that exist are kept, so this takes no time."""
    assert score_logs(folder).equals(scores)
