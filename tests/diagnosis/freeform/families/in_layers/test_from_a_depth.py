"""Tissue that is another from a depth on."""

from dataclasses import replace

import numpy as np
from diagnosis_fixtures import turns
from free_forms import DAMPING, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_layers.from_a_depth import families
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
STILL = covered(ANGLE, tip=ANGLE)
DEEPER = replace(STILL, ends={**STILL.ends, Variable.DEPTH: (40.0, 80.0)})
FRICTION, THICKER = families(DEEPER)
MESH = 1e-3  # layers meet in a place of their own: another mesh, second order in its elements


def test_at_one_inserted_length_another_damping_is_an_effect_of_the_library():
    assert [family.name for family in families(STILL)] == [FRICTION.name]


def test_as_strong_as_above_it_is_none():
    same, other = (THICKER.effect.apply(NOMINAL, 30.0, times) for times in (1.0, 5.0))
    assert same_readings(ANGLE, same, NOMINAL, within=MESH)
    assert not same_readings(ANGLE, other, NOMINAL, within=MESH)


def test_from_the_surface_on_both_are_effects_of_the_library():
    """But for the first millimetre, of 80 mm or more."""
    thicker = THICKER.effect.apply(NOMINAL, 1.0, 1.3)
    assert same_readings(ANGLE, thicker, RigParameters(damping_scale=1.3), within=0.3 / 80)
    dry = FRICTION.effect.apply(NOMINAL, 1.0, 0.003)
    assert same_readings(ANGLE, dry, LIBRARY["coulomb_friction"].apply(NOMINAL, 0.003), within=1.0 / 80)
    assert not same_readings(ANGLE, dry, NOMINAL, within=1.0 / 80)


def test_the_curve_is_told_above_and_below():
    deepest = max(trial.schedule.inserted_mm.max() for trial in DEEPER.problem.log.trials)
    depth, damping = THICKER.curve(30.0, 5.0)
    assert (np.diff(depth) > 0).all()
    np.testing.assert_allclose(depth, (0.0, 30.0, 30.0, deepest), atol=2e-3)
    np.testing.assert_allclose(damping, DAMPING * np.array([1, 1, 5, 5]))
    depth, level = FRICTION.curve(2.0 * deepest, 0.003)
    assert (np.diff(depth) > 0).all()
    np.testing.assert_allclose(level, (0.0, 0.0, 0.003, 0.003))
