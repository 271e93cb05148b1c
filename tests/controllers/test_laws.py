"""Control laws against their formulas, and what each does with a bad estimate."""

import math

import numpy as np
import pytest

from controllers.friction import FrictionAware
from controllers.laws import BaseOnly, Compensator
from controllers.least_time import LeastTime
from controllers.limits import MotorLimits
from controllers.prediction import LoopTiming
from controllers.regulator import PredictiveRegulator, Regulator
from controllers.signals import Estimate, Sample, Status
from models.errors import InvalidValue
from models.needle import NITINOL

BETA = 0.01725
LIMITS = MotorLimits()
LATE = LoopTiming(measurement_delay_s=0.04)
NO_LIMITS = MotorLimits(rate_deg_s=1e9, torque_n_mm=1e9)


def sample(time=0.0, base=0.0, torque=0.0, depth=100.0):
    return Sample(time, base, torque, depth, 50.0)


def every_controller():
    return {
        "base only": BaseOnly(LIMITS),
        "compensator": Compensator(LIMITS),
        "regulator": Regulator(NITINOL, LIMITS, damping_n_mm_s_per_mm=BETA),
        "predictive": PredictiveRegulator(NITINOL, LIMITS, LATE, damping_n_mm_s_per_mm=BETA),
        "least time": LeastTime(NITINOL, LIMITS, damping_n_mm_s_per_mm=BETA),
        "friction aware": FrictionAware(LIMITS),
    }


@pytest.mark.parametrize("name", every_controller())
@pytest.mark.parametrize("status", [Status.BAD_SAMPLE, Status.BAD_TIME, Status.DIVERGED])
def test_no_controller_hands_a_nan_to_the_motor(name, status):
    controller = every_controller()[name]
    good = Estimate(0.0, np.zeros(3), BETA)
    for i in range(5):
        controller.command(90.0, sample(0.001 * i), good)
    last = controller.command(90.0, sample(0.005), good)
    held = controller.command(90.0, sample(0.006), Estimate(math.nan, np.zeros(3), BETA, status))
    assert held.status is status
    assert held.base_deg == last.base_deg


@pytest.mark.parametrize("name", every_controller())
def test_a_reference_that_is_no_number_holds_the_base(name):
    held = every_controller()[name].command(math.nan, sample(base=12.0), Estimate(12.0, np.zeros(3)))
    assert held.base_deg == 12.0
    assert held.status is Status.BAD_SAMPLE


def commanded(law, tip_deg):
    """The second command, a second after the first: no rate limit is near."""
    law.command(0.0, sample(), Estimate(0.0))
    return law.command(90.0, sample(1.0), Estimate(tip_deg)).base_deg


def test_the_base_alone_goes_to_the_reference_whatever_the_tip_does():
    assert commanded(BaseOnly(NO_LIMITS), 40.0) == commanded(BaseOnly(NO_LIMITS), 90.0) == 90.0


@pytest.mark.parametrize("gain", [0.0, 1.0, 1.5])
def test_the_compensator_overshoots_by_its_gain_times_the_tip_error(gain):
    assert commanded(Compensator(NO_LIMITS, gain=gain), 70.0) == pytest.approx(90 + gain * 20)


@pytest.mark.parametrize("gain", [-1, math.nan])
def test_an_impossible_gain_is_refused_at_construction(gain):
    with pytest.raises(InvalidValue, match="gain"):
        Compensator(LIMITS, gain=gain)
