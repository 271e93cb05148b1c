"""The free law of the chuck: a needle that slips beyond a torque."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.chuck import families
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE, MOST_N_MM = turns(6.0), 1.0
ENDS = {"torque": (-0.7 * MOST_N_MM, MOST_N_MM)}
GRIP, HOLDER, COUPLING, LOOSE = families(SimpleNamespace(ends=ENDS))


def test_a_log_without_a_torque_has_no_chuck():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize(("torque_n_mm", "slips"), [(100.0, False), (0.3, True)])
def test_a_chuck_that_holds_more_than_the_needle_takes_is_the_nominal_one(torque_n_mm, slips):
    assert same_readings(ANGLE, GRIP.effect.apply(NOMINAL, torque_n_mm), NOMINAL) is not slips


def test_tissue_that_slips_in_its_holder_reads_the_torque_of_a_chuck_that_slips_and_turns_the_tip():
    """Once the needle has untwisted at rest, its tip has followed the base if the tissue went along."""
    angle = turns(12.0)
    rigs = [GRIP.effect.apply(NOMINAL, 0.3), HOLDER.effect.apply(NOMINAL, 0.3, math.inf)]
    chuck, tissue = predict(RIG, prepared(trial(angle)), rigs)
    np.testing.assert_array_equal(tissue.base_torque_n_mm, chuck.base_torque_n_mm)
    assert tissue.tip_angle_deg[-1] == pytest.approx(angle[-1], abs=0.1)
    assert abs(chuck.tip_angle_deg[-1] - angle[-1]) > 5.0
    # The servo gives way by 1e-6 of the lag, which counts as a turn of the tissue.
    assert same_readings(ANGLE, HOLDER.effect.apply(NOMINAL, 100.0, math.inf), NOMINAL, within=1e-5)
    assert (HOLDER.place, HOLDER.says) == (Place.TISSUE, "torque")


@pytest.mark.parametrize(("values", "holder"), [((0.3, 3600.0, 0.0), 0.3), ((100.0, 20.0, 0.0), 100.0)])
def test_tissue_without_stops_and_spring_slips_in_its_holder_at_its_torque(values, holder):
    loose, slips = LOOSE.effect.apply(NOMINAL, *values), HOLDER.effect.apply(NOMINAL, holder, math.inf)
    assert same_readings(ANGLE, loose, slips)
    assert (LOOSE.place, LOOSE.says) == (Place.TISSUE, "torque")


def test_tissue_whose_holder_gives_takes_the_needle_along_by_torque_over_stiffness():
    """Seen from the tissue, the drive turns by so much less; in the lab, the tip by as much more."""
    stiffness = 5.0
    spring = LIBRARY["base_compliance"].apply(NOMINAL, stiffness)
    chuck, tissue = predict(
        RIG, prepared(trial(ANGLE)), [spring, HOLDER.effect.apply(NOMINAL, 100.0, stiffness)]
    )
    np.testing.assert_allclose(tissue.base_torque_n_mm, chuck.base_torque_n_mm, atol=1e-9)
    turned_deg = np.degrees(chuck.base_torque_n_mm / stiffness)
    assert np.abs(turned_deg).max() > 1.0
    # In interpolation between the steps, and of the torque within one, 0.5 % of it are lost.
    np.testing.assert_allclose(
        tissue.tip_angle_deg - chuck.tip_angle_deg, turned_deg, atol=5e-3 * np.abs(turned_deg).max()
    )


def test_tissue_that_is_loose_turns_the_tip_between_its_stops():
    """Without friction and spring: the torque is that of play in the chuck, and the tip goes along."""
    chuck, tissue = predict(
        RIG,
        prepared(trial(ANGLE)),
        [f.effect.apply(NOMINAL, 1e-7, 10.0, 0.0) for f in (COUPLING, LOOSE)],
    )
    np.testing.assert_array_equal(tissue.base_torque_n_mm, chuck.base_torque_n_mm)
    assert np.abs(tissue.tip_angle_deg - chuck.tip_angle_deg).max() == pytest.approx(5.0, abs=0.1)


def test_the_torque_is_looked_for_below_the_largest():
    (torque,) = GRIP.effect.parameters
    assert all(torque.low < start < MOST_N_MM for start in torque.start)
    assert torque.high > MOST_N_MM
    _, held = GRIP.curve(0.7)
    np.testing.assert_allclose(held, 0.7)


def test_a_chuck_without_friction_and_spring_has_play():
    """Friction of a thousandth of the torque, and play of 10 deg against that of the library."""
    play = LIBRARY["chuck_backlash"].apply(NOMINAL, 10.0)
    assert same_readings(ANGLE, COUPLING.effect.apply(NOMINAL, 1e-7, 10.0, 0.0), play)
    assert not same_readings(ANGLE, COUPLING.effect.apply(NOMINAL, 0.1, 10.0, 0.0), play)


def test_a_chuck_without_friction_and_stops_is_a_spring():
    soft = LIBRARY["base_compliance"].apply(NOMINAL, 2.0)
    assert same_readings(ANGLE, COUPLING.effect.apply(NOMINAL, 1e-7, 3600.0, 2.0), soft)
    assert not same_readings(ANGLE, COUPLING.effect.apply(NOMINAL, 1e-7, 5.0, 2.0), soft)


def test_a_chuck_without_stops_and_spring_slips_at_its_torque():
    slips = GRIP.effect.apply(NOMINAL, 0.3)
    assert same_readings(ANGLE, COUPLING.effect.apply(NOMINAL, 0.3, 3600.0, 0.0), slips)
    angle_deg, torque_n_mm = COUPLING.curve(0.3, 20.0, 2.0)
    np.testing.assert_allclose(torque_n_mm, 0.3 + 2.0 * np.radians(angle_deg))
    assert angle_deg == (0.0, 10.0)


def test_every_start_is_one_of_torque_play_and_spring():
    starts = {len(p.start) for p in COUPLING.effect.parameters}
    assert starts == {18}
    assert all(p.low <= value <= p.high for p in COUPLING.effect.parameters for value in p.start)
