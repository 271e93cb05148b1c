"""Dry friction, and damping, of sections of the shaft."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.interface import PARTS
from diagnosis.freeform.families.shaft.section import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
STILL = covered(ANGLE, tip=ANGLE)
DEEPER = replace(STILL, ends={**STILL.ends, Variable.DEPTH: (40.0, 80.0)})
ONE, ROUGH, ALONG = families(DEEPER)
FLAT = [0.0] * (PARTS - 1)
DEEPEST_MM = max(trial.schedule.inserted_mm.max() for trial in DEEPER.problem.log.trials)
EVEN = LIBRARY["coulomb_friction"].apply(NOMINAL, 0.003)


def test_at_one_inserted_length_these_are_laws_of_the_depth():
    assert families(STILL) == ()


def test_one_section_that_is_the_whole_shaft_is_even_friction():
    """But for the first millimetre at the tip, of 80 mm or more."""
    whole = ONE.effect.apply(NOMINAL, 1.0, 500.0, 0.003)
    assert same_readings(ANGLE, whole, EVEN, within=1.0 / 80)
    assert not same_readings(ANGLE, whole, NOMINAL, within=1.0 / 80)


def test_one_section_that_is_not_inserted_has_no_friction():
    outside = ONE.effect.apply(NOMINAL, DEEPEST_MM + 1.0, 20.0, 0.003)
    assert same_readings(ANGLE, outside, NOMINAL)


def test_one_rough_section_that_is_the_whole_shaft_is_more_damping():
    """But for the first millimetre at the tip, of 80 mm or more."""
    nominal = DEEPER.damping_n_mm_s_per_mm
    whole = ROUGH.effect.apply(NOMINAL, 1.0, 500.0, 0.5 * nominal)
    more = LIBRARY["damping_error"].apply(NOMINAL, 1.5)
    assert same_readings(ANGLE, whole, more, within=1.0 / 80)
    assert not same_readings(ANGLE, whole, NOMINAL, within=1.0 / 80)


def test_a_short_rough_section_at_the_tip_drags_as_much_as_the_tip():
    """A section of a tenth of the depth is apart from the tip by a twentieth of it."""
    near = ROUGH.effect.apply(NOMINAL, *ROUGH.as_effect["tip_drag"](0.2))
    assert same_readings(ANGLE, near, LIBRARY["tip_drag"].apply(NOMINAL, 0.2), within=0.05)
    assert not same_readings(ANGLE, near, NOMINAL, within=0.05)


def test_sections_that_are_alike_are_even_friction():
    alike, more = (ALONG.effect.apply(NOMINAL, 0.003, c, *FLAT) for c in (0.0, 0.5))
    assert same_readings(ANGLE, alike, EVEN, within=1e-3)
    assert not same_readings(ANGLE, more, EVEN, within=1e-3)


def test_a_weaker_law_has_less_friction_in_every_section():
    free = ONE.effect.apply(NOMINAL, 10.0, 20.0, 0.004).free
    (half,) = free.times(0.5).sections
    assert (half.from_tip_mm, half.length_mm) == (10.0, 20.0)
    assert half.interface.kinetic_n_mm_per_mm == pytest.approx(0.002)
    assert free.more_rows == 1


def test_the_curves_are_told_from_the_tip_on():
    place, level = ONE.curve(30.0, 8.0, 0.02)
    assert (np.diff(place) > 0).all()
    np.testing.assert_allclose(place, (0.0, 30.0, 30.0, 38.0, 38.0, 68.0), atol=2e-3)
    np.testing.assert_allclose(level, (0.0, 0.0, 0.02, 0.02, 0.0, 0.0))
    place, level = ALONG.curve(0.002, np.log(2.0), *FLAT)
    np.testing.assert_allclose(place, DEEPEST_MM * (np.arange(PARTS) + 0.5) / PARTS)
    np.testing.assert_allclose(level, 0.004)
