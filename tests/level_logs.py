"""A log whose sensors may read otherwise about a level: its ranges, and what a law has them read."""

from diagnosis_fixtures import turns
from free_forms import covered

from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
TORQUE = 0.01 * ANGLE
RANGES = covered(ANGLE, tip=ANGLE + 1.0, torque=TORQUE, seen=(ANGLE, TORQUE))
OF_TIP_ALONE = covered(ANGLE, tip=ANGLE + 1.0, seen=(ANGLE, TORQUE))


def ranges_with(error):
    """Ranges of a log whose torque is off by an error, N mm, (N,) or one for all."""
    return covered(ANGLE, tip=ANGLE, torque=TORQUE + error, seen=(ANGLE, TORQUE))


def read(family, true, *values):
    """What a sensor reads of true values."""
    (curve,) = family.effect.apply(NOMINAL, *values).free.curves
    return true + curve.at(true)
