"""gap.rrd: measured, nominal and explained side by side."""

import pytest
from diagnosis_fixtures import concluding

from diagnosis.report import recording
from diagnosis.report.recording import log_gap
from diagnosis.selection.verdicts.verdict import VerdictKind
from models.errors import OutputExists
from sim.recording.rerun_table import entries


@pytest.fixture(scope="session")
def recorded(written):
    return written / "gap.rrd"


def test_signals_and_residuals_of_every_trial_are_there(recorded, dry):
    found = {e.entity for e in entries(recorded)}
    for i, _ in enumerate(dry.log.trials):
        root = f"/trial_{i + 1}"
        names = [f"{root}/tip_angle_deg/{n}" for n in ("measured", "nominal", "explained")]
        names += [f"{root}/residual/base_torque_n_mm/{n}" for n in ("nominal", "explained")]
        assert set(names) <= found


def test_a_signal_has_every_sample(recorded, dry):
    own = [e for e in entries(recorded) if e.entity == "/trial_3/tip_angle_deg/measured" and e.rows > 1]
    assert {e.rows for e in own} == {len(dry.log.trials[2].table)}
    tip = dry.log.trials[2]["tip_angle_deg"][-1]
    assert [e.last for e in own if e.last is not None] == [pytest.approx(tip)]


def test_what_comes_nearest_to_an_unknown_log_is_not_labelled_as_explained(dry, tmp_path, monkeypatch):
    labels = []
    monkeypatch.setattr(recording, "log_series", lambda stream, entity, label, *_: labels.append(label))
    unknown = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    log_gap(unknown, "unknown", tmp_path / "gap.rrd")
    assert {*labels} == {"measured", "nominal", "nearest"}


def test_a_recording_that_exists_is_kept(recorded, dry):
    before = recorded.read_bytes()
    with pytest.raises(OutputExists):
        log_gap(dry.found, "again", recorded)
    assert recorded.read_bytes() == before
