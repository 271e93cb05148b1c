"""Torques of detents at the tip: against the law of a narrow well, and the law that acts."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered

from diagnosis.freeform.families.in_one_place.detents import TIMES_A_TURN, families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
DETENTS = dict(zip(TIMES_A_TURN, families(covered(ANGLE, tip=ANGLE)), strict=True))


def test_a_base_that_hardly_turns_has_no_such_law():
    assert families(covered(0.001 * ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize("times", TIMES_A_TURN)
def test_a_detent_comes_back_so_many_times_in_a_turn(times):
    """What acts at an angle acts again a part of a turn on, and is what the curve tells."""
    c = np.array([0.3, 0.1, -0.2, 0.05, 0.02, 0.04, 0.1, -0.1])
    laws = DETENTS[times].effect.apply(NOMINAL, *c).free.at_tip
    angle_deg, torque = map(np.asarray, DETENTS[times].curve(*c))

    def acting(at_deg):
        return sum(
            law.orientation_n_mm_per_mm
            * np.sin(np.radians(law.orientation_cycles * at_deg - law.orientation_phase_deg))
            for law in laws
        )

    np.testing.assert_allclose(torque, acting(angle_deg), atol=1e-12)
    np.testing.assert_allclose(acting(angle_deg + 360.0 / times), torque, atol=1e-12)
    assert np.abs(acting(angle_deg + 180.0 / times) - torque).max() > 0.1


def test_four_waves_take_up_wells_of_a_tenth_of_their_distance():
    """The torque of a Gaussian well, x exp(-x^2 / 2), of 9 degrees every 90: to 1 % of its power.

    Of the m-th wave it has a part proportional to m exp(-(2 pi m 9 / 90)^2 / 2): beyond the fourth
    0.2 % of the power is left; waves of one to four a turn take up the first of them alone.
    """
    angle = np.arange(-180.0, 180.0, 0.5)
    off = (angle + 45.0) % 90.0 - 45.0
    well = off / 9.0 * np.exp(-0.5 * (off / 9.0) ** 2)

    def left(waves):
        columns = [own(np.radians(n * angle)) for n in waves for own in (np.sin, np.cos)]
        slopes = np.stack(columns, axis=1)
        rest = well - slopes @ np.linalg.lstsq(slopes, well)[0]
        return float(rest @ rest) / float(well @ well)

    waves = [law.orientation_cycles for law in DETENTS[4].effect.apply(NOMINAL, *np.ones(8)).free.at_tip]
    assert waves == [4.0, 8.0, 12.0, 16.0]
    assert left(waves) < 0.01
    assert left([1, 2, 3, 4]) > 0.5
