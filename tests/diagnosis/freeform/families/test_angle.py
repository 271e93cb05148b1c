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
TIP_ANGLE, ALONG, FIBRES, UNEVEN, KEYED, PUSHED = (
    "tip torque over tip_angle",
    "torque along the shaft over tip_angle",
    "torque along the shaft over tip_angle, twice a turn",
    "damping along the shaft over tip_angle",
    "dry friction along the shaft over tip_angle",
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
        (UNEVEN, 2, NOMINAL),
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


def test_friction_over_the_angle_is_a_level_and_what_waves_add_to_it():
    """Never below the level, which it reaches at the easiest angle of a single wave."""
    around = {family.name: family for family in families(covered(3.0 * ANGLE))}
    angles, level = around[KEYED].curve(0.002, 0.0, 0.0, 0.0003, 0.0004)
    x = 2 * np.radians(angles)
    np.testing.assert_allclose(level, 0.0025 + 0.0003 * np.sin(x) + 0.0004 * np.cos(x))
    # Points every 7.5 deg: 15 deg of this wave.
    assert 0.002 <= min(level) < 0.002 + 0.0005 * (1.0 - np.cos(np.radians(7.5)))
    laws = FAMILIES[KEYED].effect.apply(NOMINAL, 0.002, 0.0, 0.0, 0.0003, 0.0004).free.throughout
    at = np.radians(30.0)
    told = sum(
        law.kinetic_n_mm_per_mm
        + law.orientation_dry_n_mm_per_mm
        * (1.0 + np.cos(law.orientation_cycles * at - np.radians(law.orientation_phase_deg)))
        for law in laws
    )
    assert told == pytest.approx(0.0025 + 0.0003 * np.sin(2 * at) + 0.0004 * np.cos(2 * at))


@pytest.mark.parametrize(("times", "turn"), [(1.0, False), (5.0, True)])
def test_a_law_is_shown_at_the_angles_that_the_base_has_been_at(times, turn):
    low, high = covered(times * ANGLE).ends[Variable.BASE_ANGLE]
    assert (high - low > 360.0) is turn
    for family in families(covered(times * ANGLE)):
        if family.x_unit == "deg":
            angles, _ = family.curve(*(p.start[0] for p in family.effect.parameters))
            assert (angles[0], angles[-1]) == pytest.approx((-180.0, 180.0) if turn else (low, high))


def test_friction_whose_waves_are_none_is_that_of_the_library():
    flat = FAMILIES[KEYED].effect.apply(NOMINAL, 0.001, 0.0, 0.0, 0.0, 0.0)
    dry = LIBRARY["coulomb_friction"].apply(NOMINAL, 0.001)
    assert same_readings(ANGLE, flat, dry)
    wave = FAMILIES[KEYED].effect.apply(NOMINAL, 0.0005, 0.0005, 0.0, 0.0, 0.0)
    assert not same_readings(ANGLE, wave, dry)


def test_a_needle_that_hardly_turns_has_no_law_of_its_angle():
    assert families(covered(0.1 * ANGLE, tip=ANGLE)) == ()
    assert len(families(covered(ANGLE, tip=ANGLE))) == len(FAMILIES) - 1
