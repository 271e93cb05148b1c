"""Laws that grow with another variable: f(x) (1 + g(z))."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.fitting.parameterization import starts
from diagnosis.freeform.families import families_of
from diagnosis.freeform.families.readings import families
from diagnosis.freeform.fits.growth_factor import (
    VARIABLES,
    all_grown,
    grown_in_trials,
    grown_over,
    may_grow,
)
from diagnosis.replay.curve import Course
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
LATE, TORQUE = 0.8 * ANGLE, 0.01 * ANGLE
RANGES = covered(ANGLE, tip=LATE + 2.0, torque=TORQUE + 0.3, seen=(LATE, TORQUE), speed=2.0)
OF_DIRECTION = {f.name: f for f in families(RANGES)}["tip reading over direction"]


def rig_of(family, *values):
    flat = [0.0] * (len(family.effect.parameters) - len(values))
    return family.effect.apply(NOMINAL, *values, *flat)


GROWN = all_grown(OF_DIRECTION, RANGES)


@pytest.mark.parametrize("family", GROWN, ids=lambda family: family.name)
def test_a_law_whose_factor_is_flat_is_itself(family):
    assert same_readings(ANGLE, rig_of(family, 0.5, 1.5), rig_of(OF_DIRECTION, 0.5, 1.5))


def test_a_law_grows_with_each_variable_that_varies_but_its_own_and_from_trial_to_trial():
    over = [family.factor.says for family in GROWN]
    assert over == ["time", "history", "rate"]  # speed and depth are the same all the time
    of_time = {f.name: f for f in families(RANGES)}["tip reading over time"]
    alone = [f.name for f in all_grown(of_time, RANGES)]
    assert not any(name.endswith("growing with time") for name in alone)


def test_a_law_over_the_direction_that_grows_evenly_in_time():
    """From its own size at the first end to nothing at the other: 1 - u, u from -1 to 1, halved."""
    family = grown_over(OF_DIRECTION, Variable.TIME, 0.0, 4.0)
    slope = -1.0
    (curve,) = rig_of(family, 0.5, 1.5, slope).free.curves
    np.testing.assert_allclose(curve.factor.at(np.array([0.0, 1.0, 2.0, 4.0])), [2.0, 1.5, 1.0, 0.0])
    assert curve.values == rig_of(OF_DIRECTION, 0.5, 1.5).free.curves[0].values
    x, y = family.factor.curve(0.5, 1.5, slope, *[0.0] * (len(family.effect.parameters) - 3))
    np.testing.assert_allclose(y, 2.0 - 0.5 * np.asarray(x), atol=1e-12)
    assert family.factor.multiplies
    assert family.curves == (family, family.factor)


def test_a_law_that_is_another_one_in_each_trial():
    family = grown_in_trials(OF_DIRECTION, ("a.csv", "b.csv"))
    once, twice = rig_of(family, 0.5, 1.5, 0.0, 1.0).free.curves
    assert (once.trial, twice.trial) == ("a.csv", "b.csv")
    assert twice.values == tuple(2.0 * value for value in once.values)
    assert family.of_each_trial


def test_factors_and_laws_of_other_kinds_do_not_grow():
    each = {f.name: f for f in families_of(RANGES)}
    x = {name: [0.1 * p.scale for p in f.effect.parameters] for name, f in each.items()}
    may = {name for name, f in each.items() if may_grow(f.effect.apply(NOMINAL, *x[name]).free)}
    assert {"drive angle over turned_by", "torque reading over past", "drive slip over rate"} <= may
    assert not may & {"tip gain over time", "damping over time", "stiffness over torque"}
    assert not may_grow(None)
    assert not may_grow(FreeLaw())


def test_a_law_that_grows_starts_where_the_law_does_without_growing():
    slow = next(f for f in families_of(RANGES) if f.name == "drive slip over rate, beyond a level")
    family = grown_over(slow, Variable.TIME, 0.0, 4.0)
    of_law, begun = starts(slow.effect), starts(family.effect)
    assert len(of_law) == len(begun) > 1
    for one, other in zip(of_law, begun, strict=True):
        np.testing.assert_array_equal(other, [*one, *[0.0] * (other.size - one.size)])


def test_what_grows_once_does_not_grow_again():
    family = grown_over(OF_DIRECTION, Variable.TIME, 0.0, 4.0)
    assert not may_grow(rig_of(family, 0.5, 1.5, 0.3).free)


def test_all_variables_of_factors_are_known_before_the_needle_is_simulated():
    for variable in VARIABLES:
        free = rig_of(grown_over(OF_DIRECTION, variable, -1.0, 1.0), 0.5, 1.5, 0.1).free
        assert isinstance(free.curves[0].factor, Course)
