"""Free laws of the angle of the shaft: where they become effects of the library, they are these."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.angle import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
SLIDING = covered(ANGLE, tip=ANGLE, speed=2.0 * np.sin(np.linspace(0, 9, ANGLE.size)))
FAMILIES = {family.name: family for family in families(SLIDING)}
TIP_ANGLE, ALONG, FIBRES, PUSHED = (
    "tip torque over tip_angle",
    "torque along the shaft over tip_angle",
    "torque along the shaft over tip_angle, twice a turn",
    "tip torque towards one angle over axial_speed",
)


def rig_of(name, *values):
    return FAMILIES[name].effect.apply(NOMINAL, *values)


def test_once_a_turn_along_the_shaft_is_a_bent_needle():
    """a sin x + b cos x = hypot sin(x + atan2(b, a)): the phase of the library has the other sign."""
    bent = LIBRARY["needle_curvature"].apply(NOMINAL, 0.002, 40.0)
    phase = np.radians(40.0)
    sine, cosine = 0.002 * np.cos(phase), -0.002 * np.sin(phase)
    assert same_readings(ANGLE, rig_of(ALONG, sine, cosine, 0.0, 0.0), bent)
    assert not same_readings(ANGLE, rig_of(ALONG, sine, -cosine, 0.0, 0.0), bent)


def test_a_torque_that_repeats_twice_a_turn_is_of_a_flat_shaft_or_of_fibres():
    both, twice = rig_of(ALONG, 0.0, 0.0, 0.001, 0.002), rig_of(FIBRES, 0.001, 0.002)
    assert same_readings(ANGLE, both, twice)
    assert set(FAMILIES[FIBRES].places) == {Place.NEEDLE, Place.TISSUE}
    assert min(FAMILIES[FIBRES].places.values()) > 0.4
    assert FAMILIES[ALONG].places[Place.TISSUE] == FAMILIES[ALONG].places[Place.NEEDLE]


# Whatever acts at the tip has an end of the mesh of its own.
@pytest.mark.parametrize(
    ("name", "waves", "without"),
    [
        (TIP_ANGLE, 4, LIBRARY["tip_drag"].apply(NOMINAL, 1e-12)),
        (ALONG, 2, NOMINAL),
    ],
)
def test_no_waves_are_the_rig_without(name, waves, without):
    assert same_readings(ANGLE, rig_of(name, *[0.0] * (2 * waves)), without)


def test_waves_are_told_as_torques():
    angles, waves = FAMILIES[ALONG].curve(1.0, 2.0, 3.0, 4.0)
    x = np.radians(angles)
    exact = np.sin(x) + 2 * np.cos(x) + 3 * np.sin(2 * x) + 4 * np.cos(2 * x)
    np.testing.assert_allclose(waves, exact)


def test_a_torque_towards_one_angle_grows_with_the_axial_speed():
    """Without other coordinates it is proportional to the speed, and changes sign with it."""
    flat = [0.0] * (len(FAMILIES[PUSHED].effect.parameters) - 2)
    speeds, torque = FAMILIES[PUSHED].curve(0.3, 0.4, *flat)
    np.testing.assert_allclose(torque, 0.5 * speeds / np.abs(speeds).max(), atol=1e-12)
    free = FAMILIES[PUSHED].effect.apply(NOMINAL, 0.3, 0.4, *flat).free
    (wave,), (curve,) = free.at_tip, free.curves
    assert wave.varies
    assert wave.orientation_n_mm_per_mm == pytest.approx(0.5)
    assert np.radians(wave.orientation_phase_deg) == pytest.approx(-np.arctan2(0.4, 0.3))
    stronger = free.times(2.0)
    assert stronger.curves == (curve,)
    assert stronger.at_tip[0].orientation_n_mm_per_mm == pytest.approx(1.0)


@pytest.mark.parametrize(("times", "turn"), [(1.0, False), (5.0, True)])
def test_a_law_is_shown_at_the_angles_that_the_base_has_been_at(times, turn):
    low, high = covered(times * ANGLE).ends[Variable.BASE_ANGLE]
    assert (high - low > 360.0) is turn
    for family in families(covered(times * ANGLE)):
        if family.x_unit == "deg":
            angles, _ = family.curve(*(p.start[0] for p in family.effect.parameters))
            assert (angles[0], angles[-1]) == pytest.approx((-180.0, 180.0) if turn else (low, high))


def test_a_needle_that_hardly_turns_has_no_law_of_its_angle():
    assert families(covered(0.1 * ANGLE, tip=ANGLE)) == ()
    assert len(families(covered(ANGLE, tip=ANGLE))) == len(FAMILIES) - 1
