"""Torques over the angle of the shaft, in one place or over many turns: against known laws."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.freeform.families import angle as whole_turns
from diagnosis.freeform.families.in_one_place.angles import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE)
FAMILIES = {family.name: family for family in families(RANGES)}
WOUND, ALONG = (
    f"{where} over tip_angle, over many turns" for where in ("tip torque", "torque along the shaft")
)
BENT = tuple(f"{spot} torque towards one angle over base_angle" for spot in ("entry", "sheath"))


def rig_of(name, *values):
    return FAMILIES[name].effect.apply(NOMINAL, *values)


@pytest.mark.parametrize("name", FAMILIES)
def test_a_torque_is_told_as_it_acts(name):
    """At the phase that the laws have, in the unit of the place."""
    c = np.array(
        [0.3, 0.1, -0.2, 0.05, 0.02, 0.04, 0.01, -0.03][: len(FAMILIES[name].effect.parameters)]
    )
    angle_deg, torque = FAMILIES[name].curve(*c)
    free = rig_of(name, *c).free
    laws = (*free.at_tip, *free.at_entry, *free.in_sheath, *free.throughout)
    acting = sum(
        law.orientation_n_mm_per_mm
        * np.sin(np.radians(law.orientation_cycles * angle_deg - law.orientation_phase_deg))
        for law in laws
    )
    np.testing.assert_allclose(torque, acting, atol=1e-12)


def test_over_many_turns_a_torque_is_that_of_a_spring_where_the_shaft_turns_little():
    """The slowest sine, a quarter of a wave to the largest angle, is straight to 1 % up to a sixth."""
    angle_deg, torque = FAMILIES[WOUND].curve(0.2, *np.zeros(7))
    farthest = np.abs(ANGLE).max()
    assert angle_deg[-1] == pytest.approx(farthest, rel=0.01)
    near = np.abs(angle_deg) < farthest / 6
    spring = 0.2 * 0.5 * np.pi / angle_deg[-1]
    np.testing.assert_allclose(torque[near], spring * angle_deg[near], atol=0.012 * 0.2)


def test_along_the_shaft_a_whole_wave_is_that_of_a_law_once_a_turn():
    (once,) = (
        f for f in whole_turns.families(RANGES) if f.name == "torque along the shaft over tip_angle"
    )
    farthest = max(abs(end) for end in RANGES.ends["base_angle"])
    (sine, cosine) = (0.001, 0.0005)
    slow = rig_of(ALONG, *np.zeros(4), sine, cosine, 0.0, 0.0).free.throughout[2]
    assert slow.orientation_cycles == pytest.approx(3 * 90.0 / farthest)
    turn = once.effect.apply(NOMINAL, sine, cosine, 0.0, 0.0).free.throughout[0]
    assert slow.but(orientation_cycles=1.0) == turn


def test_no_waves_change_nothing_but_the_mesh():
    for name in BENT:
        flat = rig_of(name, 1e-12, 0.0, 0.0, 0.0)
        assert same_readings(ANGLE, flat, rig_of(name, 0.0, 1e-12, 0.0, 0.0))
        assert not same_readings(ANGLE, flat, rig_of(name, 0.1, 0.0, 0.0, 0.0))


def test_what_they_depend_on_has_a_word_and_a_base_at_rest_has_none():
    assert {family.says for family in FAMILIES.values()} == {"base_angle", "tip_angle"} <= VOCABULARY
    assert families(covered(0.1 * ANGLE, tip=ANGLE)) == ()
