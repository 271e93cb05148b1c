"""Recordings of the cross-check: what was checked stands beside what it was checked against."""

import numpy as np
import pytest

from sim.files import Destination, publishing
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
    paths = [tmp_path / name for name in recordings.NAMES]
    with publishing(Destination(folder=tmp_path), paths) as results:
        recordings.write_recordings(results, tmp_path)
    assert sorted(tmp_path.iterdir()) == sorted(paths)
    shown = {e.entity for e in entries(tmp_path / recordings.FILES[50.0])}
    assert {f"/angles/{n}_deg" for n in ("tip_angle", "native_tip", "closed_form_tip")} <= shown
