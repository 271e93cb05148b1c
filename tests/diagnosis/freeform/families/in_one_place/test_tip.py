"""Free laws of the tip: where they become effects of the library, they are these."""

import numpy as np
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_one_place.tip import families
from diagnosis.freeform.families.over_rate.friction import PLACES
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
FAMILIES = {family.name: family for family in families(covered(ANGLE, tip=ANGLE))}
RATE, FLAT = "tip torque over rate", (0.0,) * PLACES


def rig_of(name, *values):
    return FAMILIES[name].effect.apply(NOMINAL, *values)


def test_drag_in_one_place_at_the_tip_is_that_of_the_library():
    drag = LIBRARY["tip_drag"].apply(NOMINAL, 0.05)
    assert same_readings(ANGLE, rig_of(RATE, 0.05, 1e-12, 0.0, *FLAT), drag)
    assert not same_readings(ANGLE, rig_of(RATE, 0.05, 0.1, 0.0, *FLAT), drag)


def test_curves_are_told_as_torques():
    rates, torque = FAMILIES[RATE].curve(0.2, 0.1, 0.5, *FLAT)
    np.testing.assert_allclose(torque[-1], (0.2 * rates[-1] + 0.1) * 1.5)
    np.testing.assert_allclose(torque[0], -(0.2 * -rates[0] + 0.1) * 0.5)


def test_drag_at_the_tip_may_depend_on_the_rate():
    """With a curve that is straight over log rate: a power of the rate."""
    family = FAMILIES[RATE]
    law = family.effect.apply(NOMINAL, 0.2, 1e-12, 0.0, 0.0, 0.7, *FLAT[2:]).free.at_tip[0]
    places = np.geomspace(*law.rate_range_rad_s, PLACES)
    power = 1.4 / np.log(places[-1] / places[0])
    middle = np.sqrt(places[0] * places[-1])
    np.testing.assert_allclose(law.rate_curve, (places / middle) ** power)
    rates, torque = family.curve(0.2, 0.0, 0.0, 0.0, 0.7, *FLAT[2:])
    inside = (np.abs(rates) > places[0]) & (np.abs(rates) < places[-1])
    expected = 0.2 * rates * (np.abs(rates) / middle) ** power
    np.testing.assert_allclose(np.array(torque)[inside], expected[inside])


def test_a_needle_that_hardly_turns_has_no_law_over_its_turns():
    still = families(covered(0.1 * ANGLE, tip=ANGLE))
    assert [family.name for family in still] == [RATE, "tip torque over time"]


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


def test_friction_that_hardly_twists_is_dry_friction_at_the_tip():
    """The twist adds a thousandth to the presliding of 0.1 deg."""
    name = "tip torque over turned_by"
    dry = rig_of(RATE, 1e-12, 0.1, 0.0, *FLAT)
    assert same_readings(ANGLE, rig_of(name, 0.1, 1e-4), dry, within=1e-5)
    assert not same_readings(ANGLE, rig_of(name, 0.1, 20.0), dry, within=1e-5)
    angle_deg, torque = FAMILIES[name].curve(0.1, 20.0)
    assert (angle_deg, torque) == ((0.0, 20.0, 40.0), (0.0, 0.1, 0.1))
