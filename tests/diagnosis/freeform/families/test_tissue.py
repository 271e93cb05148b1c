"""Free laws of the tissue: where they are constant, they are elastic tissue of the library."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.tissue import families
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
FAMILIES = {family.name: family for family in families(covered(ANGLE, tip=ANGLE))}
ELASTIC = LIBRARY["tissue_viscoelasticity"].apply(NOMINAL, 0.01, 0.4)
FLAT = [0.0] * 8
FLOWS = "tissue that flows"
CURVES = [name for name in FAMILIES if name != FLOWS]
TORQUE = 0.02 * ANGLE
SLIPS = "tissue slip over torque"
(SLIP,) = (f for f in families(covered(ANGLE, torque=TORQUE, seen=(ANGLE, TORQUE))) if f.name == SLIPS)


@pytest.mark.parametrize("name", CURVES)
def test_a_constant_curve_is_elastic_tissue_of_the_library(name):
    effect = FAMILIES[name].effect
    along = [1.0] if "follows" in {p.name for p in effect.parameters} else []
    flat = [0.0] * (len(effect.parameters) - 2 - len(along))
    # Parts of the shaft meet in places of their own: another mesh, second order in its elements.
    within = 1e-3 if name.endswith("position") else 1e-6
    constant, stiffer = (effect.apply(NOMINAL, 0.01, 0.4, *along, c, *flat[1:]) for c in (0.0, 0.2))
    assert same_readings(ANGLE, constant, ELASTIC, within=within)
    assert not same_readings(ANGLE, stiffer, ELASTIC, within=within)


def test_the_curve_is_the_stiffness():
    _, stiffness = FAMILIES["elastic tissue over time"].curve(0.01, 0.4, 0.5, np.log(2.0), *FLAT[1:])
    np.testing.assert_allclose(stiffness, 0.02)


def test_its_viscosity_may_stay_while_its_stiffness_changes():
    """Twice as stiff throughout: the same as half the time constant, as k tau stays."""
    effect = FAMILIES["elastic tissue over time"].effect
    stays, goes_along = (
        effect.apply(NOMINAL, 0.01, 0.4, along, np.log(2.0), *FLAT[1:]) for along in (0.0, 1.0)
    )
    half, same = (LIBRARY["tissue_viscoelasticity"].apply(NOMINAL, 0.02, t) for t in (0.2, 0.4))
    assert same_readings(ANGLE, stays, half, within=1e-6)
    assert same_readings(ANGLE, goes_along, same, within=1e-6)
    assert not same_readings(ANGLE, stays, same, within=1e-3)


def test_tissue_that_flows_is_elastic_below_its_torque_and_is_told_by_it():
    flows = FAMILIES[FLOWS]
    far, soon = (flows.effect.apply(NOMINAL, 0.01, 0.4, at_deg) for at_deg in (720.0, 5.0))
    assert same_readings(ANGLE, far, ELASTIC, within=1e-6)
    assert not same_readings(ANGLE, soon, ELASTIC, within=1e-2)
    twist_deg, torque = flows.curve(0.01, 0.4, 30.0)
    np.testing.assert_allclose(twist_deg, [0.0, 30.0, 60.0])
    np.testing.assert_allclose(torque, np.array([0.0, 1.0, 1.0]) * 0.01 * np.pi / 6)


def test_it_is_of_what_the_log_has():
    says = {family.says for family in FAMILIES.values()}
    assert says == {"time", "history", "position", "torque"}
    assert all(family.place is Place.TISSUE for family in FAMILIES.values())


@pytest.mark.parametrize("variable", [Variable.TORQUE, Variable.AXIAL_SPEED])
def test_tissue_that_turns_at_one_rate_is_tissue_that_turns_by_a_line_in_time(variable):
    """Of tissue that turns at any torque or speed alike: 20 deg/s for six seconds are 120 deg."""
    rate = Curve(acts_on=ActsOn.TISSUE_SLIP, variable=variable, places=(-9.0, 9.0), values=(20.0, 20.0))
    line = Curve(
        acts_on=ActsOn.TISSUE_ANGLE, variable=Variable.TIME, places=(0.0, 6.0), values=(0.0, 120.0)
    )
    slips, turns_by = (replace(NOMINAL, free=FreeLaw(curves=(one,))) for one in (rate, line))
    assert same_readings(ANGLE, slips, turns_by, within=1e-3)
    assert not same_readings(ANGLE, slips, NOMINAL, within=0.02)


def test_a_block_that_does_not_slip_is_the_nominal_rig_and_one_that_does_turns_beyond_its_torque():
    assert same_readings(ANGLE, SLIP.effect.apply(NOMINAL, 1.0, 0.0), NOMINAL)
    torque, rate = SLIP.curve(0.5, 12.0)
    np.testing.assert_allclose(rate, -np.array(rate)[::-1])
    assert np.interp((-0.5, 0.0, 0.5), torque, rate) == pytest.approx(0.0)
    assert (rate[-1], torque[-1]) == (pytest.approx(12.0), pytest.approx(1.2 * TORQUE.max(), rel=0.05))
    assert SLIP.places == {Place.TISSUE: 1.0}
