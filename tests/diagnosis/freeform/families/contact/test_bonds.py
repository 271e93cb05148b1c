"""Free laws of bonds that break: where they never do, they are dry friction; torn ones are nothing."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import COARSE, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.contact.bonds import families
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from models.tissue import Interface
from sim.discretisation import PRESLIDING_DEG

ANGLE, LEVEL = turns(6.0), 0.001
DRY = LIBRARY["coulomb_friction"].apply(NOMINAL, LEVEL)
BONDS, HEALING, AT_ENTRY, AT_TIP = families(covered(ANGLE, tip=ANGLE))
RUBBING_TIP = replace(NOMINAL, free=FreeLaw(at_tip=(Interface(kinetic_n_mm_per_mm=0.05),)))


def test_bonds_that_heal_at_once_are_dry_friction_and_others_are_not():
    """All is left of bonds that do not weaken, or that have grown again before anything breaks them."""
    assert same_readings(
        ANGLE, HEALING.effect.apply(NOMINAL, LEVEL, PRESLIDING_DEG, 10.0, 5.0, 1.0, 0.5), DRY
    )
    weak = HEALING.effect.apply(NOMINAL, LEVEL, PRESLIDING_DEG, 10.0, 5.0, 0.05, 0.3)
    assert not same_readings(ANGLE, weak, DRY)
    for other in ((10.0, 0.5, 0.05, 0.3), (90.0, 5.0, 0.05, 0.3), (10.0, 5.0, 0.05, 0.9)):
        law = HEALING.effect.apply(NOMINAL, LEVEL, PRESLIDING_DEG, *other)
        assert not same_readings(ANGLE, weak, law)
    broken, friction = HEALING.curve(LEVEL, 2.5, 9.0, 6.0, 0.1, 0.5)
    assert (broken[0], broken[-1]) == pytest.approx((0.0, 1.0))
    assert (friction[0], friction[-1]) == pytest.approx((LEVEL, 0.1 * LEVEL))


def test_a_base_that_hardly_turns_has_no_such_law():
    assert families(covered(0.001 * ANGLE, tip=ANGLE)) == ()


def test_bonds_that_never_break_are_dry_friction_with_a_twist():
    """The twist adds a thousandth to the presliding of 0.1 deg, which is 2 in 1000 of what is read."""
    assert same_readings(ANGLE, BONDS.effect.apply(NOMINAL, LEVEL, 1e-4, 10.0, 1.0), DRY, within=1e-5)
    assert not same_readings(ANGLE, BONDS.effect.apply(NOMINAL, LEVEL, 1e-4, 10.0, 0.05), DRY)
    assert not same_readings(ANGLE, BONDS.effect.apply(NOMINAL, LEVEL, 40.0, 10.0, 1.0), DRY)
    slip_deg, friction = BONDS.curve(LEVEL, 5.0, 10.0, 0.2)
    np.testing.assert_allclose(friction, LEVEL * (0.2 + 0.8 * np.exp(-slip_deg / 10.0)))
    assert slip_deg[-1] == pytest.approx(60.0)


@pytest.mark.parametrize(
    ("bond", "dry"),
    [(AT_ENTRY, LIBRARY["entry_friction"].apply(NOMINAL, 0.05)), (AT_TIP, RUBBING_TIP)],
)
def test_a_bond_in_one_place_that_never_breaks_is_dry_friction_there(bond, dry):
    apply = bond.effect.apply
    assert same_readings(ANGLE, apply(NOMINAL, 0.05, 1e-4, 10.0, 1.0), dry, within=1e-4)
    assert not same_readings(ANGLE, apply(NOMINAL, 0.05, 1e-4, 10.0, 0.05), dry, within=1e-3)


@pytest.mark.parametrize("bond", [AT_ENTRY, AT_TIP])
def test_a_bond_in_one_place_that_has_torn_leaves_nothing(bond):
    """It holds for the first of 90 degrees; what is read at rest is as without it."""
    torn = bond.effect.apply(NOMINAL, 0.05, 1.0, 0.1, 0.01)
    without, with_bond = (rest_of(rig) for rig in (NOMINAL, torn))
    np.testing.assert_allclose(with_bond, without, atol=0.01 * 0.05 + 1e-3)
    whole = rest_of(bond.effect.apply(NOMINAL, 0.05, 1.0, 0.1, 1.0))
    assert np.abs(whole - without).max() > 0.02


def rest_of(rig):
    """The base torque at rest after a turn of 90 degrees, N mm: of what holds the needle."""
    hold = np.concatenate([np.linspace(0.0, 90.0, 100), np.full(900, 90.0)])
    read = predict(RIG, prepared(trial(hold)), [rig], COARSE)[0]
    return read["base_torque_n_mm"][-100:]
