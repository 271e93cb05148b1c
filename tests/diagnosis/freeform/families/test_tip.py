"""Free laws of the tip: where they become effects of the library, they are these."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.tip import families
from diagnosis.replay.rig_parameters import NOMINAL
from models.tissue import RATE_POINTS

ANGLE = turns(6.0)
FAMILIES = {family.name: family for family in families(covered(ANGLE, tip=ANGLE))}
RATE, TIP_ANGLE, ALONG, UNEVEN = (
    "tip torque over rate",
    "tip torque over tip_angle",
    "torque along the shaft over tip_angle",
    "damping along the shaft over tip_angle",
)


FLAT = (0.0,) * RATE_POINTS


def rig_of(name, *values):
    return FAMILIES[name].effect.apply(NOMINAL, *values)


def test_drag_in_one_place_at_the_tip_is_that_of_the_library():
    drag = LIBRARY["tip_drag"].apply(NOMINAL, 0.05)
    assert same_readings(ANGLE, rig_of(RATE, 0.05, 1e-12, 0.0, *FLAT), drag)
    assert not same_readings(ANGLE, rig_of(RATE, 0.05, 0.1, 0.0, *FLAT), drag)


def test_once_a_turn_along_the_shaft_is_a_bent_needle():
    """a sin x + b cos x = hypot sin(x + atan2(b, a)): the phase of the library has the other sign."""
    bent = LIBRARY["needle_curvature"].apply(NOMINAL, 0.002, 40.0)
    phase = np.radians(40.0)
    sine, cosine = 0.002 * np.cos(phase), -0.002 * np.sin(phase)
    assert same_readings(ANGLE, rig_of(ALONG, sine, cosine, 0.0, 0.0), bent)
    assert not same_readings(ANGLE, rig_of(ALONG, sine, -cosine, 0.0, 0.0), bent)


# Whatever acts at the tip has an end of the mesh of its own.
@pytest.mark.parametrize(
    ("name", "waves", "without"),
    [
        (TIP_ANGLE, 4, LIBRARY["tip_drag"].apply(NOMINAL, 1e-12)),
        (ALONG, 2, NOMINAL),
        (UNEVEN, 2, NOMINAL),
    ],
)
def test_no_waves_are_the_rig_without(name, waves, without):
    assert same_readings(ANGLE, rig_of(name, *[0.0] * (2 * waves)), without)


def test_curves_are_told_as_torques():
    rates, torque = FAMILIES[RATE].curve(0.2, 0.1, 0.5, *FLAT)
    np.testing.assert_allclose(torque[-1], (0.2 * rates[-1] + 0.1) * 1.5)
    np.testing.assert_allclose(torque[0], -(0.2 * -rates[0] + 0.1) * 0.5)
    angles, waves = FAMILIES[ALONG].curve(1.0, 2.0, 3.0, 4.0)
    x = np.radians(angles)
    exact = np.sin(x) + 2 * np.cos(x) + 3 * np.sin(2 * x) + 4 * np.cos(2 * x)
    np.testing.assert_allclose(waves, exact)


def test_drag_at_the_tip_may_depend_on_the_rate():
    """With a curve that is straight over log rate: a power of the rate."""
    family = FAMILIES[RATE]
    law = family.effect.apply(NOMINAL, 0.2, 1e-12, 0.0, 0.0, 0.7, *FLAT[2:]).free.at_tip[0]
    places = np.geomspace(*law.rate_range_rad_s, RATE_POINTS)
    power = 1.4 / np.log(places[-1] / places[0])
    middle = np.sqrt(places[0] * places[-1])
    np.testing.assert_allclose(law.rate_curve, (places / middle) ** power)
    rates, torque = family.curve(0.2, 0.0, 0.0, 0.0, 0.7, *FLAT[2:])
    inside = (np.abs(rates) > places[0]) & (np.abs(rates) < places[-1])
    expected = 0.2 * rates * (np.abs(rates) / middle) ** power
    np.testing.assert_allclose(np.array(torque)[inside], expected[inside])


def test_a_needle_that_hardly_turns_has_no_law_of_its_angle():
    still = families(covered(0.1 * ANGLE, tip=ANGLE))
    assert [family.name for family in still] == [RATE]


SLIDING = covered(ANGLE, tip=ANGLE, speed=2.0 * np.sin(np.linspace(0, 9, ANGLE.size)))
CUTTING = next(f for f in families(SLIDING) if f.name == "tip torque over axial_speed")


def test_a_torque_that_is_the_same_at_every_speed_is_the_one_that_does_not_change():
    flat = [0.0] * (len(CUTTING.effect.parameters) - 2)
    own, twice = (CUTTING.effect.apply(NOMINAL, 0.05, 0.1, *c) for c in (flat, [0.7] * len(flat)))
    assert same_readings(ANGLE, own, rig_of(RATE, 0.05, 0.1, 0.0, *FLAT))
    assert not same_readings(ANGLE, twice, own)


def test_a_torque_over_the_speed_is_told_at_a_slow_rate():
    flat = [0.0] * (len(CUTTING.effect.parameters) - 2)
    speeds, torque = CUTTING.curve(1.0, 0.1, *flat)
    np.testing.assert_allclose(torque, 0.1 + 0.03)
    assert min(speeds) < 0 < max(speeds)


PUSHED = next(f for f in families(SLIDING) if f.name == "tip torque over tip_angle and axial_speed")


def test_a_torque_towards_one_angle_grows_with_the_axial_speed():
    """Without other coordinates it is proportional to the speed, and changes sign with it."""
    flat = [0.0] * (len(PUSHED.effect.parameters) - 2)
    speeds, torque = PUSHED.curve(0.3, 0.4, *flat)
    np.testing.assert_allclose(torque, 0.5 * speeds / np.abs(speeds).max(), atol=1e-12)
    free = PUSHED.effect.apply(NOMINAL, 0.3, 0.4, *flat).free
    (wave,), (curve,) = free.at_tip, free.curves
    assert wave.varies
    assert wave.orientation_n_mm_per_mm == pytest.approx(0.5)
    assert np.radians(wave.orientation_phase_deg) == pytest.approx(-np.arctan2(0.4, 0.3))
    stronger = free.times(2.0)
    assert stronger.curves == (curve,)
    assert stronger.at_tip[0].orientation_n_mm_per_mm == pytest.approx(1.0)


def test_uneven_damping_is_told_as_damping_and_stays_positive():
    beta = covered(ANGLE, tip=ANGLE).damping_n_mm_s_per_mm
    angles, damping = FAMILIES[UNEVEN].curve(0.0, 0.0, 0.3 * beta, 0.2 * beta)
    x = np.radians(angles)
    np.testing.assert_allclose(damping, beta * (1 + 0.3 * np.sin(2 * x) + 0.2 * np.cos(2 * x)))
    _, strong = FAMILIES[UNEVEN].curve(0.0, 3.0 * beta, 0.0, 4.0 * beta)
    assert min(strong) > 0
    laws = rig_of(UNEVEN, 0.0, 0.0, 0.3 * beta, 0.2 * beta).free.throughout
    at = np.radians(30.0)
    told = sum(
        law.orientation_viscous_n_mm_s_per_mm
        * np.cos(law.orientation_cycles * at - np.radians(law.orientation_phase_deg))
        for law in laws
    )
    assert told == pytest.approx(beta * (0.3 * np.sin(2 * at) + 0.2 * np.cos(2 * at)))
