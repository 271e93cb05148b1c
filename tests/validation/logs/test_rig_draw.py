"""Draws of rigs whose effects have drawn signatures."""

import numpy as np
import pytest

from validation.logs.case import NEEDS_LOAD, NEEDS_SLIDING
from validation.logs.comparison import RigComparison
from validation.logs.motions import draw_motions, draw_plan
from validation.logs.rig_draw import CLOSENESS, OFF_NOMINAL, draw_rig
from validation.logs.schedule import PARAMETER_ERRORS
from validation.logs.sensors import draw_sensors
from validation.logs.strengths.families import FAMILIES, UNMODELLED_FAMILIES, without

EFFECTS = (*FAMILIES, *UNMODELLED_FAMILIES)


def drawn(name, ends=(1.0, 20.0)):
    """The first rig of 20 draws of trials, and the comparison that it was drawn for."""
    rng = np.random.default_rng(EFFECTS.index(name))
    for _ in range(20):
        plan = draw_plan(rng, short=True, slides=name in NEEDS_SLIDING, loads=name in NEEDS_LOAD)
        comparison = RigComparison(draw_motions(rng, plan)[:1], draw_sensors(rng), coarse=True)
        rig = draw_rig(rng, comparison, "single", (name,), ends)
        if rig is not None:
            return comparison, rig
    return None


@pytest.mark.parametrize("name", EFFECTS)
def test_every_effect_can_be_given_its_signature(name):
    comparison, rig = drawn(name)
    signature = comparison.signature(rig, without(rig, name))
    assert 1.0 / CLOSENESS <= signature <= 20.0 * CLOSENESS
    assert {*rig.effects, *rig.outside} == {name}
    values = [p for effect in (rig.effects | rig.outside).values() for p in effect.values()]
    assert all(value == float(f"{value:.5g}") for value in values)


def test_a_narrow_range_is_met_within_the_closeness():
    comparison, rig = drawn("coulomb_friction", (3.0, 3.001))
    signature = comparison.signature(rig, without(rig, "coulomb_friction"))
    assert 3.0 / CLOSENESS < signature < 3.001 * CLOSENESS


def test_a_signature_beyond_the_family_is_given_up():
    assert drawn("tip_angle_bias", (1e6, 2e6)) is None


def test_off_nominal_rigs_are_off_in_both_constants(drive, sensors):
    comparison = RigComparison([drive(dt=0.01)], sensors, coarse=True)
    rig = draw_rig(np.random.default_rng(0), comparison, "off_nominal", (), (1.0, 20.0))
    scales = [rig.effects[name]["scale"] for name in PARAMETER_ERRORS]
    assert all(0 < abs(scale - 1) <= OFF_NOMINAL for scale in scales)
