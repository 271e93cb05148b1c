"""Tissue that flows, and a block of tissue that slips on its support."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.flowing import families
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
TORQUE = 0.02 * ANGLE
FLOWS, SLIP = families(covered(ANGLE, torque=TORQUE, seen=(ANGLE, TORQUE)))
ELASTIC = LIBRARY["tissue_viscoelasticity"].apply(NOMINAL, 0.01, 0.4)


def test_no_block_slips_where_there_is_no_torque():
    assert [f.name for f in families(covered(ANGLE, tip=ANGLE))] == [FLOWS.name]
    assert {FLOWS.says, SLIP.says} <= set(VOCABULARY)
    assert FLOWS.place is Place.TISSUE


def test_tissue_that_flows_is_elastic_below_its_torque_and_is_told_by_it():
    far, soon = (FLOWS.effect.apply(NOMINAL, 0.01, 0.4, at_deg) for at_deg in (720.0, 5.0))
    assert same_readings(ANGLE, far, ELASTIC, within=1e-6)
    assert not same_readings(ANGLE, soon, ELASTIC, within=1e-2)
    twist_deg, torque = FLOWS.curve(0.01, 0.4, 30.0)
    np.testing.assert_allclose(twist_deg, [0.0, 30.0, 60.0])
    np.testing.assert_allclose(torque, np.array([0.0, 1.0, 1.0]) * 0.01 * np.pi / 6)


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
