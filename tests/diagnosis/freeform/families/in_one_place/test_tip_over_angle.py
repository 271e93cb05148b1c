"""Drag and dry friction at the tip over its own angle: from those of the library to one angle alone."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_one_place.tip_over_angle import families
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import COARSE
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
RANGES = covered(3.0 * ANGLE, tip=3.0 * ANGLE)
DRAG, DRY = families(RANGES)
RATE_DEG_S, IDS = 4.0, ("drag", "dry")
WAVES = (0.03, 0.04, 0.0, 0.0, 0.0, 0.0, 0.01, 0.0)


def rig_of(family, *values):
    return family.effect.apply(NOMINAL, *values)


def test_drag_without_waves_is_that_of_the_library():
    drag = LIBRARY["tip_drag"].apply(NOMINAL, 0.2)
    assert same_readings(ANGLE, rig_of(DRAG, 0.2, *[0.0] * 8), drag)
    assert not same_readings(ANGLE, rig_of(DRAG, 0.2, *WAVES), drag)


@pytest.mark.parametrize(("family", "slow"), [(DRAG, np.radians(RATE_DEG_S)), (DRY, 1.0)], ids=IDS)
def test_a_base_that_turns_slowly_feels_what_is_told_at_the_angle_of_the_tip(family, slow):
    """In addition to the nominal torque; late by damping inserted (free + inserted / 2) / rigidity.

    These 0.5 s are 2 deg, in which a wave of one turn changes by 3.5 % of its size; points every 7.5 deg
    make another 0.2 % of it, and so does the rate of a tip that gives by 0.1e-3 of 0.07 rad/s.
    """
    late_s = RIG.tissue.damping_n_mm_s_per_mm * 90.0 * (60.0 + 45.0) / RIG.rigidity_n_mm2
    share = np.radians(RATE_DEG_S) * late_s + 0.004
    values = (0.02, 0.03, 0.04, *[0.0] * 6)
    turned = prepared(trial(RATE_DEG_S * np.arange(0.0, 40.0, 0.04), step=0.04))
    with_law, nominal = (
        predict(RIG, turned, [r], COARSE)[0] for r in (rig_of(family, *values), NOMINAL)
    )
    angles, told = family.curve(*values)
    expected = slow * np.interp(with_law[TIP], angles, told)
    felt = with_law[TORQUE] - nominal[TORQUE]
    moving = slice(100, None)
    np.testing.assert_allclose(felt[moving], expected[moving], rtol=0, atol=share * slow * 0.05)


@pytest.mark.parametrize("family", [DRAG, DRY], ids=IDS)
def test_what_acts_is_what_is_told_and_never_less_than_its_level(family):
    angles, told = family.curve(0.02, *WAVES)
    x = np.radians(angles)
    above = 0.05 + 0.01 + 0.03 * np.sin(x) + 0.04 * np.cos(x) + 0.01 * np.sin(4 * x)
    np.testing.assert_allclose(told, 0.02 + above)
    assert min(told) >= 0.02
    laws = rig_of(family, 0.02, *WAVES).free.at_tip
    waves = [np.cos(law.orientation_cycles * x - np.radians(law.orientation_phase_deg)) for law in laws]
    viscous = sum(
        law.viscous_n_mm_s_per_mm + law.orientation_viscous_n_mm_s_per_mm * wave
        for law, wave in zip(laws, waves, strict=True)
    )
    dry = sum(
        law.kinetic_n_mm_per_mm + law.orientation_dry_n_mm_per_mm * (1.0 + wave)
        for law, wave in zip(laws, waves, strict=True)
    )
    np.testing.assert_allclose(viscous if family is DRAG else dry, told)
    np.testing.assert_allclose(dry if family is DRAG else viscous, 0.0)


def test_starts_have_waves_in_four_directions():
    level, sine, cosine, *others = DRAG.effect.parameters
    assert len(level.start) == len(sine.start) == 4
    assert len({*zip(sine.start, cosine.start, strict=True)}) == 4
    assert {start for p in others for start in p.start} == {0.0}


def test_a_needle_that_hardly_turns_has_no_law_of_the_angle_of_its_tip():
    assert families(covered(0.1 * ANGLE, tip=ANGLE)) == ()
