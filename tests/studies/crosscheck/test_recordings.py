"""Recordings of the cross-check: what was checked stands beside what it was checked against."""

import numpy as np
import pytest

from models.errors import OutputExists
from sim.kernel import memory_map
from sim.recording.rerun_table import entries
from studies.crosscheck import motion, recordings, turn


@pytest.mark.parametrize("free_mm", turn.FREE_MM)
def test_the_turn_has_the_tips_of_all_three(free_mm):
    recording, turned = recordings.record_turn(free_mm), turn.turned(free_mm)
    assert np.array_equal(recording["tip_angle_deg"], turned.run.tip_deg)
    assert np.array_equal(recording["native_tip_deg"], turned.native_tip_deg)
    assert np.array_equal(recording["closed_form_tip_deg"], turned.exact_tip_deg)
    assert recording.group("shaft").shape[0] == turned.run.time_s.size
    assert recording["free_mm"][0] == free_mm


def test_the_reversal_is_the_run_of_the_balances():
    recording, run = recordings.record_reversal(), motion.reversal(motion.elastic_gelatin())
    assert recording["drive_work_mj"] == pytest.approx(1e3 * run.outputs[:, memory_map.O_WORK])
    assert recording.group("tissue").any()


def test_all_are_written_once_and_show_every_tip(tmp_path):
    recordings.write_recordings(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(recordings.NAMES)
    shown = {e.entity for e in entries(tmp_path / recordings.FILES[50.0])}
    assert {f"/angles/{n}_deg" for n in ("tip_angle", "native_tip", "closed_form_tip")} <= shown
    with pytest.raises(OutputExists):
        recordings.write_recordings(tmp_path)
