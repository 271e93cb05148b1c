"""Tissue that holds the needle until it slides."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered, same_readings

from diagnosis.effects.effect import Place
from diagnosis.freeform.families.holding import families
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from models.tissue import Interface

ANGLE = turns(6.0)
SLIDING = 2.0 * np.sin(np.linspace(0, 9, ANGLE.size))
SHAFT, TIP = families(covered(ANGLE, tip=ANGLE, speed=SLIDING))
LEVELS = {"shaft": (SHAFT, "throughout", 0.004), "tip": (TIP, "at_tip", 0.3)}


def test_a_needle_that_does_not_slide_has_no_such_law():
    assert families(covered(ANGLE, tip=ANGLE)) == ()
    assert [family.place for family in (SHAFT, TIP)] == [Place.TISSUE, Place.NEEDLE]
    assert {family.says for family in (SHAFT, TIP)} == {"history"}


@pytest.mark.parametrize(("family", "where", "level"), LEVELS.values(), ids=LEVELS)
def test_at_rest_it_is_dry_friction_that_twists_before_it_slips(family, where, level):
    """Whatever share of the axial speed counts, there is none."""
    dry = Interface(
        kinetic_n_mm_per_mm=level, stiffness_n_mm_per_rad_per_mm=float(level / np.radians(20.0))
    )
    own = replace(NOMINAL, free=FreeLaw(**{where: (dry,)}))
    for share in (0.01, 1.0):
        held = family.effect.apply(NOMINAL, level, 20.0, share)
        assert same_readings(ANGLE, held, own, within=1e-4)
    assert not same_readings(ANGLE, held, NOMINAL, within=0.01)


@pytest.mark.parametrize(("family", "where", "level"), LEVELS.values(), ids=LEVELS)
def test_sliding_releases_what_it_holds_the_sooner_the_larger_the_share(family, where, level):
    """The base has turned by 5 deg, rests, and the needle slides: the torque that is held is let go."""
    time = np.arange(0.0, 4.0, 0.01)
    turn = np.interp(time, [0.0, 1.0], [0.0, 5.0])
    ready = prepared(trial(turn, speed=np.where(time > 2.0, 1.0, 0.0)))
    rigs = [family.effect.apply(NOMINAL, level, 20.0, share) for share in (1e-3, 0.03, 0.3)]
    left = [found.base_torque_n_mm[-1] for found in predict(RIG, ready, rigs)]
    held = predict(RIG, ready, rigs)[0].base_torque_n_mm[199]
    assert left[0] > 0.8 * held > 0.0
    assert left[0] > 1.2 * left[1] > 1.2 * 1.2 * left[2]


def test_the_law_is_told_as_its_torque_over_the_twist():
    x, y = SHAFT.curve(0.004, 20.0, 0.1)
    assert (x, y) == ((0.0, 20.0, 40.0), (0.0, 0.004, 0.004))
    starts = {len(p.start) for p in SHAFT.effect.parameters}
    assert starts == {6}
    assert all(p.low <= value <= p.high for p in TIP.effect.parameters for value in p.start)
