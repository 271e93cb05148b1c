"""Where inertia counts: its size, the samples that carry it, and the replay of a heavy shaft."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from diagnosis_fixtures import RIG, log_of

from diagnosis.log.nominal_rig import NominalInertia, NominalNeedle, SensorNoise
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial
from diagnosis.prepare.motion.inertia import (
    InertiaTorque,
    inertia_torque,
    inertia_warning,
    smooth_motion,
    total_inertia_kg_m2,
)
from diagnosis.prepare.prepare import prepare
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL

HEAVY = RIG.but(
    needle=NominalNeedle(diameter_mm=10.0, shear_modulus_gpa=80.0, density_g_cm3=8.0),
    inertia=NominalInertia(base_kg_m2=2e-6, tip_kg_m2=1e-6),
    sensors=SensorNoise(tip_angle_noise_deg=0.1, base_torque_noise_n_mm=0.002, base_angle_noise_deg=0.0),
)
LENGTH_MM = 150.0
INERTIA = 8000 * np.pi / 32 * 0.01**4 * LENGTH_MM * 1e-3 + 3e-6


def swing(time_s, hz=1.0):
    return 20 * np.sin(np.pi * hz * time_s) ** 2


def alpha_rad_s2(time_s, hz=1.0):
    return np.radians(20) * 2 * (np.pi * hz) ** 2 * np.cos(2 * np.pi * hz * time_s)


def heavy_log(time_s, hz=1.0):
    """A heavy shaft that swings in next to no tissue, whose torque is J alpha."""
    table = pd.DataFrame(
        {
            "time_s": time_s,
            "base_angle_deg": swing(time_s, hz),
            "base_torque_n_mm": 1e3 * INERTIA * alpha_rad_s2(time_s, hz),
            "inserted_mm": 50.0,
            "free_mm": 100.0,
            "speed_mm_s": 0.0,
        }
    )
    rig = HEAVY.but(tissue=HEAVY.tissue.but(damping_n_mm_s_per_mm=1e-8))
    return RigLog(rig=rig, trials=(Trial(name="trial_01.csv", table=table),))


def test_shaft_drive_and_tip_add_up():
    assert total_inertia_kg_m2(HEAVY, LENGTH_MM) == pytest.approx(INERTIA)


def test_the_torque_of_a_swing_is_inertia_times_its_acceleration():
    time = np.arange(0.0, 4.0, 0.005)
    found = inertia_torque(HEAVY, time, swing(time), LENGTH_MM, 0.002)
    expected = 1e3 * INERTIA * np.sqrt(np.mean(alpha_rad_s2(time) ** 2)) / 0.002
    # The second difference over 2 h loses (w h)^2 / 3 = 0.03 %; the ends are one-sided.
    assert found.rms_sigma == pytest.approx(expected, rel=0.01)
    assert found.counts


def test_the_papers_needle_feels_none_of_it():
    ready, _ = prepare(log_of(NOMINAL))
    assert not ready.trials[0].inertia.counts
    assert ready.warnings == ()


@pytest.mark.parametrize(("step_s", "warned"), [(0.01, False), (0.2, True)])
def test_samples_that_are_too_rare_for_the_inertia_are_named(step_s, warned):
    time = np.arange(0.0, 4.0, step_s)
    found = inertia_torque(HEAVY, time, swing(time), LENGTH_MM, 0.002)
    assert ("trial_01.csv" in inertia_warning("trial_01.csv", found)) is warned


def test_nothing_is_said_where_inertia_does_not_count():
    assert inertia_warning("a", InertiaTorque(rms_sigma=0.01, lost_sigma=9.0)) == ""


def test_the_smooth_motion_goes_through_every_sample():
    time = np.cumsum(np.random.default_rng(1).uniform(0.01, 0.03, 50))
    finer, motion = smooth_motion(time, swing(time))
    assert np.all(np.diff(finer) > 0)
    assert np.interp(time, finer, motion) == pytest.approx(swing(time), abs=1e-12)
    # A cubic spline is off by 5/384 h^4 times the fourth derivative, 20 deg / 2 (2 pi)^4.
    bound = 5 / 384 * 0.03**4 * 10 * (2 * np.pi) ** 4
    inner = slice(12, -12)
    assert np.abs(motion - swing(finer))[inner].max() < 3 * bound


@pytest.mark.parametrize("step_s", [0.01, 0.02, 0.013])
def test_the_replay_of_a_heavy_shaft_is_its_inertia_at_any_rate_of_samples(step_s):
    """Also where steps of the replay and samples of the log do not coincide."""
    log = heavy_log(np.arange(0.0, 4.0, step_s))
    ready, _ = prepare(log)
    torque = replay(ready)[0].base_torque_n_mm
    measured = log.trials[0]["base_torque_n_mm"]
    inner = slice(20, -20)
    error = np.sqrt(np.mean((torque - measured)[inner] ** 2) / np.mean(measured[inner] ** 2))
    assert error < 0.02  # (w h)^2 / 12 of the centred difference, and linear interpolation of it


def test_straight_lines_between_samples_would_not_do(monkeypatch):
    """Negative control: without a smooth motion, steps of half a sample see spikes."""
    monkeypatch.setattr("diagnosis.prepare.prepared_log.between_samples", lambda *lines: lines)
    log = heavy_log(np.arange(0.0, 4.0, 0.02))
    ready, _ = prepare(log)
    straight = replace(ready, trials=(replace(ready.trials[0], inertia=InertiaTorque()),))
    torque = replay(straight)[0].base_torque_n_mm
    measured = log.trials[0]["base_torque_n_mm"]
    inner = slice(20, -20)
    error = np.sqrt(np.mean((torque - measured)[inner] ** 2) / np.mean(measured[inner] ** 2))
    assert error > 0.3
