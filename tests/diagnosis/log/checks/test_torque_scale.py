"""The size of the torque beside that of the stated needle and tissue."""

import numpy as np
import pytest
from analytic_log import TORQUE, change_rig, change_trial, scaled

from diagnosis.log.checks.torque_scale import torque_over_twist
from diagnosis.log.rig_log import read_rig_log

BOTH = ("turns.csv", "slides.csv")
RAD = np.pi / 180


def change_both(log, change):
    for name in BOTH:
        change_trial(log, change, name)


def without_tip(t):
    return t.drop(columns="tip_angle_deg")


def in_radians(t):
    return t.assign(**{name: RAD * t[name] for name in t if name.endswith("angle_deg")})


def claims(log, *, angles=1.0, torque=1.0):
    """Claims in the same units as the readings: scatter says nothing."""

    def change(c):
        c["sensors"]["tip_angle_noise_deg"] *= angles
        c["sensors"]["base_angle_noise_deg"] *= angles
        c["sensors"]["base_torque_noise_n_mm"] *= torque

    change_rig(log, change)


def test_a_torque_far_beyond_the_twist_is_told(log):
    change_trial(log, scaled("base_torque_n_mm", 100))
    (warning,) = read_rig_log(log).warnings
    assert warning.startswith("turns.csv: base_torque_n_mm is up to ")
    assert "times what twists the nominal needle from base_angle_deg to tip_angle_deg" in warning


def test_angles_in_radians_with_their_claims_are_told_by_the_torque(log):
    change_both(log, in_radians)
    claims(log, angles=RAD)
    (warning,) = read_rig_log(log).warnings
    assert warning.startswith("turns.csv, slides.csv: base_torque_n_mm is up to")
    assert "angles in rad: multiply by 57.2958" in warning


def test_without_the_tip_the_swing_of_the_base_is_the_measure(log):
    change_both(log, lambda t: without_tip(in_radians(t)))
    claims(log, angles=RAD)
    (warning,) = read_rig_log(log).warnings
    assert "by all that base_angle_deg swings" in warning


@pytest.mark.parametrize("seen", [lambda t: t, without_tip])
def test_a_torque_in_newton_metres_with_its_claim_is_told(log, seen):
    change_both(log, lambda t: seen(scaled("base_torque_n_mm", 1e-3)(t)).round(7))
    claims(log, torque=1e-3)
    (warning,) = read_rig_log(log).warnings
    assert warning.startswith("turns.csv, slides.csv: base_torque_n_mm is down to")
    assert "torque in N m: multiply by 1000" in warning


def test_radians_and_newton_metres_with_their_claims_are_told(log):
    change_both(log, lambda t: scaled("base_torque_n_mm", 1e-3)(in_radians(t)))
    claims(log, angles=RAD, torque=1e-3)
    (warning,) = read_rig_log(log).warnings
    assert warning.startswith("turns.csv, slides.csv: base_torque_n_mm is down to")


@pytest.mark.parametrize("scale", [0.02, 1000.0])
@pytest.mark.parametrize("seen", [lambda t: t, without_tip])
def test_another_scale_of_needle_tissue_and_torque_is_no_fault(log, scale, seen):
    """The same rig by similarity: all torques times a factor."""
    change_both(log, lambda t: seen(scaled("base_torque_n_mm", scale)(t)))
    claims(log, torque=scale)

    def stiffer(c):
        c["needle"]["shear_modulus_gpa"] = min(27.2 * scale, 1000.0)
        c["needle"]["diameter_mm"] *= (27.2 * scale / c["needle"]["shear_modulus_gpa"]) ** 0.25
        c["tissue"]["damping_n_mm_s_per_mm"] = min(0.017 * scale, 10.0)

    change_rig(log, stiffer)
    assert read_rig_log(log).warnings == ()


def test_a_rig_that_hardly_moves_is_not_judged(log):
    still = {"base_angle_deg": 0.01, "tip_angle_deg": 0.0}
    rng = np.random.default_rng(1)

    def quiet(t):
        torque = rng.normal(0, TORQUE, len(t))
        moved = {name: factor * t[name] + rng.normal(0, 0.4, len(t)) for name, factor in still.items()}
        return t.assign(base_torque_n_mm=torque, **moved)

    change_both(log, quiet)
    assert not any("base_torque_n_mm" in warning for warning in read_rig_log(log).warnings)


def test_the_torque_of_a_spring_is_once_its_stiffness_times_its_twist():
    base, tip = np.linspace(0, 90, 500), np.linspace(0, 30, 500)
    torque = 1.7 * np.radians(base - tip)
    # The largest hundredth of the torque is left out: 1 % of a ramp.
    assert torque_over_twist(base, tip, torque, 1.7) == pytest.approx(0.99, abs=1e-6)
