"""The skin where the shaft enters."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_one_place.skin import families
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
(SKIN,) = families(covered(ANGLE, tip=ANGLE))


def test_skin_that_hardly_winds_up_is_friction_at_the_entry():
    """A dry element gives way by about 0.1 deg of itself: a skin of 0.5 deg differs by some per cent."""
    stiff = SKIN.effect.apply(NOMINAL, 0.5, 0.5)
    dry = LIBRARY["entry_friction"].apply(NOMINAL, 0.5)
    assert same_readings(ANGLE, stiff, dry, within=0.05)
    assert not same_readings(ANGLE, SKIN.effect.apply(NOMINAL, 0.5, 40.0), dry, within=0.05)


def test_before_it_slips_its_torque_grows_with_the_angle():
    """Turned by 6 deg and held until the tissue has relaxed, in which only the skin holds the shaft."""
    level, twist_deg = 1.0, 60.0
    turn = np.interp(np.arange(0.0, 30.0, 0.01), [0.0, 1.0], [0.0, 6.0])
    (run,) = predict(RIG, prepared(trial(turn)), [SKIN.effect.apply(NOMINAL, level, twist_deg)])
    per_deg = level / twist_deg
    free = RIG.rigidity_n_mm2 / trial(turn)["free_mm"][0] * np.pi / 180.0  # N mm / deg
    expected = 6.0 / (1.0 / free + 1.0 / per_deg)
    assert run.base_torque_n_mm[-1] == pytest.approx(expected, rel=0.02)


def test_the_law_is_told_as_its_torque_over_the_twist():
    assert SKIN.curve(0.4, 20.0) == ((0.0, 20.0, 40.0), (0.0, 0.4, 0.4))
    assert len({len(p.start) for p in SKIN.effect.parameters}) == 1
