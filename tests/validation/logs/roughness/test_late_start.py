"""Recordings that begin late: cut from a simulation that began at rest, angles as they were."""

from dataclasses import replace

import numpy as np
import pytest

from validation.logs.comparison import RigComparison
from validation.logs.roughness.late_start import MOVING_DEG_S, late_start
from validation.logs.roughness.recording import record
from validation.logs.sensors import BASE, TIP, TORQUE
from validation.rig.simulation import CellCounts, ideal_signals

COARSE = CellCounts(24, 20, 60)


@pytest.fixture
def trials(drive):
    """Four, sampled at 100 Hz."""
    motion = replace(drive(lambda t: 90 * np.sin(0.8 * t), end=12.0), per_sample=4)
    return [motion] * 4


@pytest.mark.parametrize("begins", ["moving", "twisted"])
@pytest.mark.parametrize("share", [0.5, 1.0])
def test_some_or_all_trials_have_a_past(drawn, trials, begins, share):
    one = drawn(late_start, begins=begins, share_of_trials=share)
    late = [m.lead > 0 for m in one.motions(np.random.default_rng(1), trials)]
    assert any(late)
    assert all(late) or share < 1


def test_a_moving_start_is_within_the_motion(drawn, trials):
    one = drawn(late_start, begins="moving", share_of_trials=1.0)
    for motion in one.motions(np.random.default_rng(1), trials):
        assert (motion.base_deg == trials[0].base_deg).all()
        rate = np.gradient(motion.base_deg, motion.dt_s)[motion.lead]
        assert abs(rate) > MOVING_DEG_S
        assert 0 < motion.lead < motion.base_deg.size / 3
        assert motion.lead % motion.per_sample == 0


def test_a_twisted_start_is_at_rest_after_a_turn(drawn, trials):
    one = drawn(late_start, begins="twisted", share_of_trials=1.0)
    for motion in one.motions(np.random.default_rng(1), trials):
        before, recorded = motion.base_deg[: motion.lead], motion.base_deg[motion.lead :]
        assert before[0] == 0.0
        assert 60 <= abs(recorded[0]) <= 400
        assert recorded == pytest.approx(recorded[0] + trials[0].base_deg)
        assert np.ptp(before[-20:]) < 0.1  # it has rested for a twentieth of a second at least
        assert not motion.speed_mm_s[: motion.lead].any()
        sizes = {v.size for v in (motion.base_deg, motion.inserted_mm, motion.free_mm)}
        assert sizes == {motion.lead + trials[0].base_deg.size}


def test_a_load_does_not_change_before_the_recording(drawn, drive):
    loaded = drive(end=4.0, load=lambda time_s: 1.0 + time_s)
    one = drawn(late_start, begins="twisted", share_of_trials=1.0)
    (motion,) = one.motions(np.random.default_rng(1), [loaded])
    assert (motion.tip_torque_n_mm[: motion.lead] == 1.0).all()


def test_the_log_shows_the_rest_of_a_longer_simulation(drive, make_rig, sensors):
    """Dry friction holds what was wound up: the first torque is not zero, time is, angles go on."""
    whole = replace(drive(end=8.0), per_sample=4)
    late = replace(whole, lead=800)
    rig = make_rig(coulomb_friction={"level": 0.004})
    rows = []
    for motion in (whole, late):
        signals = [ideal_signals(rig, motion, COARSE)]
        rows += record(np.random.default_rng(0), sensors, (), [motion], signals)
    quiet = {name: 6 * sensors.noise[name] for name in (BASE, TORQUE, TIP)}
    assert rows[1]["time_s"][0] == 0.0
    assert rows[1]["time_s"].size == rows[0]["time_s"].size - 200
    for name, noise in quiet.items():
        assert rows[1][name] == pytest.approx(rows[0][name][200:], abs=noise)


def test_what_comes_before_the_recording_does_not_count_as_signature(drive, sensors, make_rig):
    """A late torque shows while the torque changes: after half a second, and 5 s of rest, no more."""
    whole = drive(lambda t: 60 * np.clip(t, 0, 0.5), dt=0.01, end=7.0)
    delayed, none = make_rig(torque_sensor_delay={"delay": 0.1}), make_rig()
    seen = RigComparison([whole], sensors).signature(delayed, none)
    late = RigComparison([replace(whole, lead=550)], sensors).signature(delayed, none)
    assert late < 0.05 < seen
