"""Noise of the sensors, from the data."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, RIG, TIP, TORQUE, trial, turns
from scipy.signal import lfilter

from diagnosis.log.trial import SENSORS, FileRows
from diagnosis.prepare.noise.drift import AllowedDrift, Drift
from diagnosis.prepare.noise.sensor_noise import Noise, base_noise_deg, estimate_noise


def residuals(size=4000, seed=1):
    """White noise of both sensors under what a nominal model lacks."""
    rng = np.random.default_rng(seed)
    slow = np.sin(np.linspace(0, 20, size))
    time_s = 0.01 * np.arange(size)
    return {
        "tip_angle_deg": [(time_s, 5 * slow + rng.normal(0, TIP, size))],
        "base_torque_n_mm": [(time_s, 0.2 * slow + rng.normal(0, TORQUE, size))],
    }


def test_a_wrong_claim_is_named_and_the_readings_are_believed():
    claims = RIG.sensors.but(tip_angle_noise_deg=3 * TIP)
    noise = estimate_noise(RIG.but(sensors=claims), residuals(), BASE)
    # Fourth differences of 4000 samples are good to 2 %: four of these.
    assert noise["tip_angle_deg"] == pytest.approx(TIP, rel=0.08)
    (warning,) = noise.warnings
    assert "tip_angle_deg" in warning
    assert "rig.yaml claims 0.75" in warning


def test_a_true_claim_raises_no_warning_and_the_readings_are_believed_too():
    noise = estimate_noise(RIG, residuals(), BASE)
    assert noise.warnings == ()
    assert noise["base_torque_n_mm"] == pytest.approx(TORQUE, rel=0.08)
    assert noise["base_torque_n_mm"] != TORQUE
    assert noise["base_angle_deg"] == BASE


def test_the_claim_stands_where_too_little_was_read():
    noise = estimate_noise(RIG, {"tip_angle_deg": [(np.arange(5.0), np.zeros(5))]}, BASE)
    assert noise["tip_angle_deg"] == TIP
    assert noise["base_torque_n_mm"] == TORQUE


def test_a_claim_of_no_noise_and_no_reading_leave_one_unit():
    claims = RIG.sensors.but(tip_angle_noise_deg=0)
    assert estimate_noise(RIG.but(sensors=claims), {}, BASE)["tip_angle_deg"] == 1.0


@pytest.mark.parametrize(("true", "believed"), [(1.0, 1.0), (1.4, 1.0), (5.0, 5.0), (0.2, 0.2)])
def test_the_encoders_claim_stands_unless_it_scatters_quite_otherwise(true, believed):
    read = turns() + np.random.default_rng(2).normal(0, true * BASE, turns().size)
    # 1200 samples: 4 % of standard error.
    assert base_noise_deg(RIG, [trial(read)]) == pytest.approx(believed * BASE, rel=0.16)


def test_the_quietest_trial_tells_the_encoders_noise():
    rng = np.random.default_rng(3)
    loud, quiet = (trial(turns() + rng.normal(0, s * BASE, turns().size)) for s in (9.0, 4.0))
    assert base_noise_deg(RIG, [loud, quiet]) == pytest.approx(4 * BASE, rel=0.16)


def test_rows_that_were_moved_to_where_the_base_was_tell_no_noise():
    """Nine tenths of them lie on the curve to which they were moved; the others scatter."""
    angle = turns()
    moved = np.arange(angle.size) >= angle.size / 10
    read = angle + np.where(moved, 0.0, np.random.default_rng(4).normal(0, 5 * BASE, angle.size))
    one = trial(read)
    stamps_s = one["time_s"] + 1e-3 * moved
    rows = FileRows(stamps_s=stamps_s, taken_s=one["time_s"], errors_s=np.zeros((1, angle.size)))
    assert base_noise_deg(RIG, [one]) < BASE
    assert base_noise_deg(RIG, [replace(one, rows=rows)]) == pytest.approx(5 * BASE, rel=0.3)
    every = replace(rows, stamps_s=one["time_s"] + 1e-3)
    assert base_noise_deg(RIG, [replace(one, rows=every)]) == BASE


def test_a_residual_far_below_its_noise_names_the_units():
    """Readings in N m with few digits: most differences are 0, so that the claim stands."""
    coarse = np.repeat([0.0, 1e-4, 0.0, 2e-4], 500)
    found = {"base_torque_n_mm": [(0.01 * np.arange(coarse.size), coarse)]}
    noise = estimate_noise(RIG, found, BASE)
    assert noise["base_torque_n_mm"] == TORQUE
    (warning,) = noise.warnings
    # rms of 0, 1, 0, 2 in 1e-4 N mm, over 0.01.
    assert warning.startswith("base_torque_n_mm: the residual of the nominal rig is 0.011 of the noise")
    assert "check the units of base_torque_n_mm and base_angle_deg" in warning


def test_an_encoder_that_scatters_otherwise_is_told():
    (warning,) = estimate_noise(RIG, residuals(), 5 * BASE).warnings
    assert "base_angle_deg: the readings scatter by 0.1, rig.yaml claims 0.02" in warning


@pytest.mark.parametrize(("motion", "told"), [(0.0, 1.0), (20.0, 2.0)])
def test_rare_rows_of_smoothed_readings_tell_noise_up_to_twice_the_claim(motion, told):
    """Fourth differences of a fast motion in rare rows are no noise."""
    time_s = 0.3 * np.arange(400)
    left = motion * TIP * np.sin(5.0 * time_s) + np.random.default_rng(3).normal(0, TIP, time_s.size)
    found = {"tip_angle_deg": [(time_s, left)]}
    noise = estimate_noise(RIG, found, BASE, smoothed=["tip_angle_deg"])
    # Fourth differences of 400 samples: 6 % of standard error.
    assert noise["tip_angle_deg"] == pytest.approx(told * TIP, rel=0.2)
    if motion:
        assert estimate_noise(RIG, found, BASE)["tip_angle_deg"] > 5 * TIP


def test_what_was_told_when_the_log_was_read_is_not_told_again():
    claims = RIG.sensors.but(tip_angle_noise_deg=40 * TIP)
    rig = RIG.but(sensors=claims)
    assert len(estimate_noise(rig, residuals(), BASE).warnings) == 1
    assert estimate_noise(rig, residuals(), BASE, told=["tip_angle_deg"]).warnings == ()


@pytest.mark.parametrize(("size", "coloured"), [(0.8, True), (1.5, True), (6.0, False)])
def test_what_is_far_above_the_claim_is_no_noise(size, coloured):
    """Correlated over 300 ms, beside white noise of half of the claim: differences show the claim."""
    rng = np.random.default_rng(5)
    parts = []
    for _ in range(3):
        kept = np.exp(-1 / 30)
        slow = lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.normal(size=4000))
        values = TORQUE * (size * slow + 0.5 * rng.normal(size=slow.size))
        parts.append((0.01 * np.arange(slow.size), values))
    noise = estimate_noise(RIG, {"base_torque_n_mm": parts}, BASE)
    assert ("base_torque_n_mm" in noise.colour) is coloured
    if coloured:
        assert noise["base_torque_n_mm"] == pytest.approx(np.hypot(size, 0.5) * TORQUE, rel=0.25)
    for claim in (0.0, 0.04 * TORQUE):  # none, and one that is no measure of what the readings do
        assert estimate_noise(claiming(claim), {"base_torque_n_mm": parts}, BASE).colour
    shaken = claiming(0.01 * TORQUE)  # a sensor that is so much better than its readings
    assert not estimate_noise(shaken, {"base_torque_n_mm": parts}, BASE).colour


def claiming(torque_noise):
    return RIG.but(sensors=RIG.sensors.but(base_torque_noise_n_mm=torque_noise))


def test_each_sensor_may_have_a_drift_of_its_own():
    """In units of its noise, and until it is taken back."""
    torque, tip = SENSORS
    plain = Noise(sigma={torque: TORQUE, tip: TIP})
    both = plain.with_drift(torque, AllowedDrift(size=2.0 * TORQUE, zeroed=True))
    both = both.with_drift(tip, AllowedDrift(size=0.5 * TIP))
    assert both.drift(torque) == Drift(size_sigma=2.0, zeroed=True)
    assert both.drift(tip) == Drift(size_sigma=0.5)
    assert plain.drift(tip) is None
    assert not both.same(plain)
    assert (both.alike(plain, tip), both.alike(plain, torque)) == (False, False)
    without = both.with_drift(tip, None)
    assert without.alike(plain, tip)
    assert without.with_drift(torque, None).same(plain)
