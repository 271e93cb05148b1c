"""Diagnosing a folder of logs: reports that exist are kept, logs that cannot be read are refused."""

import json

import pytest

from validation.score.run import diagnose_all


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


def test_a_report_that_exists_is_kept_and_tasks_can_be_watched(unusable):
    (unusable / "reports").mkdir()
    kept = unusable / "reports" / "case_001.json"
    kept.write_text("kept")
    seen = []
    diagnose_all(
        unusable / "logs", unusable / "reports", workers=1, watched=lambda t: seen.append(t) or t
    )
    assert kept.read_text() == "kept"
    assert seen == [[]]


def test_reports_hold_no_ground_truth(folder):
    """The diagnosis is given a log's folder alone."""
    for path in (folder / "reports").iterdir():
        assert not {"kind", "signature", "answer"} & json.loads(path.read_text()).keys()
