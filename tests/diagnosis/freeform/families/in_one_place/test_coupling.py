"""A coupling between drive and needle whose spring hardens."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import VOCABULARY, covered

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_one_place.coupling import families
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE, MOST_N_MM = turns(6.0), 1.0
ENDS = {Variable.TORQUE: (-0.7 * MOST_N_MM, MOST_N_MM), Variable.TIME: (0.0, 6.0)}
FAMILY, HELICAL, IN_TIME = families(SimpleNamespace(ends=ENDS, library=LIBRARY))
FLAT = [0.0] * (len(IN_TIME.effect.parameters) - 1)


def test_a_log_without_a_torque_has_no_coupling():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize(("angle_deg", "torque_n_mm"), [(5.0, 0.1), (20.0, 2.0)])
def test_its_spring_is_linear_and_cubic(angle_deg, torque_n_mm):
    torques, angles = (np.array(own) for own in FAMILY.curve(angle_deg, torque_n_mm))
    share = angles / angle_deg
    np.testing.assert_allclose(0.5 * torque_n_mm * (share + share**3), torques, atol=1e-12)
    assert torques[-1] > MOST_N_MM
    assert torques[0] == -torques[-1]


def test_one_that_hardly_hardens_is_the_spring_of_the_library():
    """Half of the torque at which it is twice as stiff, 50 N mm, over 1000 deg."""
    assert_same_spring(50.0 / np.radians(1000.0), FAMILY.effect.apply(NOMINAL, 1000.0, 100.0))


def test_a_helical_one_of_the_same_stiffness_both_ways_is_the_spring_of_the_library():
    soft, helical = (
        LIBRARY["base_compliance"].apply(NOMINAL, 3.0),
        HELICAL.effect.apply(NOMINAL, 3.0, 1.0),
    )
    one = prepared(trial(ANGLE))
    (expected,), (found,) = (predict(RIG, one, [rig]) for rig in (soft, helical))
    np.testing.assert_array_equal(found.tip_angle_deg, expected.tip_angle_deg)
    (other,) = predict(RIG, one, [HELICAL.effect.apply(NOMINAL, 3.0, 0.4)])
    assert np.abs(other.tip_angle_deg - expected.tip_angle_deg).max() > 1.0


@pytest.mark.parametrize(("torque_n_mm", "stiffness"), [(0.7, 4.0), (-0.6, 1.6)])
def test_a_helical_one_has_another_stiffness_as_it_unwinds(torque_n_mm, stiffness):
    coupling = HELICAL.effect.apply(NOMINAL, 4.0, 0.4).free.coupling
    assert (coupling.stiffness_n_mm_per_rad, coupling.unwinding_ratio) == (4.0, 0.4)
    angle_deg = np.degrees(torque_n_mm / stiffness)
    assert np.interp(torque_n_mm, *HELICAL.curve(4.0, 0.4)) == pytest.approx(angle_deg)


@pytest.mark.parametrize("factor", [1.0, 2.0])
def test_one_that_does_not_change_is_the_spring_of_the_library(factor):
    values = (3.0 / factor, np.log(factor), *FLAT[1:])
    assert_same_spring(3.0, IN_TIME.effect.apply(NOMINAL, *values))
    _, stiffness = IN_TIME.curve(*values)
    np.testing.assert_allclose(stiffness, 3.0)


def test_one_that_softens_gives_way_further_at_the_end():
    softens = IN_TIME.effect.apply(NOMINAL, 3.0, 0.0, -0.8, *FLAT[2:])
    _, stiffness = IN_TIME.curve(3.0, 0.0, -0.8, *FLAT[2:])
    assert (np.diff(stiffness) < 0).all()
    (curve,) = softens.free.curves
    assert curve.factor.values[-1] / curve.factor.values[0] == pytest.approx(
        stiffness[0] / stiffness[-1]
    )


def assert_same_spring(stiffness, rig):
    """The spring of the library, in N mm / rad, and a coupling read the same."""
    soft, hardening = LIBRARY["base_compliance"].apply(NOMINAL, stiffness), rig
    one = prepared(trial(ANGLE))
    (expected,) = predict(RIG, one, [soft])
    read = {"base_torque_n_mm": expected.base_torque_n_mm, "tip_angle_deg": expected.tip_angle_deg}
    (found,) = predict(RIG, replace(one, readings=read), [hardening])
    (nominal,) = predict(RIG, one, [NOMINAL])
    off, effect = (
        np.sqrt(np.mean((own.tip_angle_deg - expected.tip_angle_deg) ** 2)) for own in (found, nominal)
    )
    # The torque that it follows is the measured one, smoothed: its own noise turns the needle.
    assert off < 0.1 * effect


def test_what_it_depends_on_has_a_word():
    assert {FAMILY.says, IN_TIME.says} <= set(VOCABULARY)
