"""Families of effects: parameters that the rig takes, and signatures that grow with the strength."""

import numpy as np
import pytest

from validation.logs.comparison import RigComparison
from validation.logs.motions import LogPlan, draw_motions
from validation.logs.strengths.families import (
    ALL_FAMILIES,
    FAMILIES,
    TWO_SIDED,
    UNLISTED_FAMILIES,
    UNMODELLED_FAMILIES,
    WRONG_CONSTANT_FAMILIES,
    with_effect,
    without,
)
from validation.rig.modelled import MODELLED, WRONG_CONSTANTS
from validation.rig.unmodelled.library import UNLISTED, UNMODELLED


def test_every_effect_has_a_family():
    assert tuple(FAMILIES) == MODELLED
    assert tuple(UNMODELLED_FAMILIES) == UNMODELLED
    assert tuple(WRONG_CONSTANT_FAMILIES) == WRONG_CONSTANTS
    assert tuple(UNLISTED_FAMILIES) == UNLISTED
    assert {*FAMILIES, *WRONG_CONSTANTS} > TWO_SIDED


@pytest.fixture(scope="module")
def motions():
    """A trial that slides and on whose tip a torque acts: every effect shows."""
    plan = LogPlan(trials=1, total_s=10.0, rate_hz=100, sliding=1.0, growing=0.0, loaded=1.0)
    return draw_motions(np.random.default_rng(8), plan)


@pytest.mark.parametrize("name", ALL_FAMILIES)
def test_a_stronger_effect_has_a_larger_signature(name, motions, sensors, make_rig):
    family, rig = ALL_FAMILIES[name], make_rig()
    by_strength = family.draw(np.random.default_rng(3))
    comparison = RigComparison(motions, sensors, coarse=True)
    strengths = np.geomspace(family.low, family.high, 3)
    changed = [with_effect(rig, name, by_strength(strength)) for strength in strengths]
    signatures = [comparison.signature(one, rig) for one in changed]
    assert signatures == sorted(signatures)
    assert signatures[-1] > max(1.0, 3 * signatures[0])


@pytest.mark.parametrize("name", ALL_FAMILIES)
def test_without_undoes_with_effect(name, make_rig):
    rig = make_rig(tip_angle_bias={"bias": 1.0}) if name != "tip_angle_bias" else make_rig()
    parameters = ALL_FAMILIES[name].draw(np.random.default_rng(0))(ALL_FAMILIES[name].low)
    changed = with_effect(rig, name, parameters)
    assert changed != rig
    assert without(changed, name) == rig


def test_stiction_falls_no_faster_than_viscous_torque_rises():
    """The steepest fall of (static - kinetic) exp(-(w / s)^2) is sqrt(2/e) = 0.858 of it per s."""
    for seed in range(50):
        p = FAMILIES["stiction"].draw(np.random.default_rng(seed))(0.01)
        assert (p["static"] - p["kinetic"]) / p["stribeck"] * 0.858 <= 0.015 * (1 + 1e-3)
