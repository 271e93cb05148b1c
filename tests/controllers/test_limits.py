"""Commands never exceed what the motor can do."""

import math

import numpy as np
import pytest

from controllers.laws import BaseOnly
from controllers.limits import LimitedBase, MotorLimits, ShaftLimits, rigid_needle_estimate
from controllers.signals import Command, Estimate, Sample, Status
from models.errors import InvalidValue
from models.modes import InsertedNeedle, ramp
from models.needle import NITINOL


def sample(time=0.0, base=0.0, torque=0.0, depth=100.0):
    return Sample(time, base, torque, depth, 50.0)


def test_the_base_turns_no_faster_than_the_motor_can():
    controller = BaseOnly(MotorLimits(rate_deg_s=100))
    commands = [controller.command(90.0, sample(0.01 * i), Estimate(0.0)) for i in range(100)]
    steps = np.diff([c.base_deg for c in commands])
    assert steps.max() == pytest.approx(1.0)
    assert commands[5].rate_limited
    assert commands[-1].base_deg == 90.0
    assert not commands[-1].rate_limited


def test_at_its_torque_limit_the_base_goes_no_further_but_may_go_back():
    controller = BaseOnly(MotorLimits(torque_n_mm=2.0))
    controller.command(0.0, sample(0.0), Estimate(0.0))
    pushed = controller.command(90.0, sample(0.1, torque=2.5), Estimate(0.0))
    assert pushed == Command(0.0, pushed.rate_limited, True)
    back = controller.command(-10.0, sample(0.2, torque=2.5), Estimate(0.0))
    assert back.base_deg == pytest.approx(-10.0)


def test_the_first_command_sets_out_from_the_measured_base():
    base = LimitedBase(MotorLimits(rate_deg_s=100))
    assert math.isnan(base.base_deg)
    assert base.toward(90.0, sample(base=12.0), Status.OK).base_deg == 12.0
    base.reset()
    assert math.isnan(base.base_deg)


@pytest.mark.parametrize("status", [Status.BAD_SAMPLE, Status.BAD_TIME, Status.DIVERGED])
def test_a_bad_estimate_holds_the_last_command_and_keeps_its_status(status):
    base = LimitedBase(MotorLimits())
    base.toward(0.0, sample(), Status.OK)
    last = base.toward(30.0, sample(1.0), Status.OK)
    assert base.toward(90.0, sample(2.0), status) == Command(last.base_deg, status=status)


def test_without_torsion_the_tip_is_where_the_base_is():
    assert rigid_needle_estimate(sample(base=42.0)).tip_deg == 42.0


@pytest.mark.parametrize("field", ["rate_deg_s", "torque_n_mm"])
@pytest.mark.parametrize("bad", [0, -1, math.nan])
def test_impossible_limits_are_refused_by_their_name(field, bad):
    with pytest.raises(InvalidValue, match=field):
        MotorLimits(**{field: bad})


BETA = 0.01725
GENTLE = ShaftLimits(needle=NITINOL, damping_n_mm_s_per_mm=BETA, shear_stress_mpa=100.0)


@pytest.mark.parametrize(("free", "sample_s"), [(50.0, 0.002), (50.0, 0.01), (5.0, 0.002)])
def test_the_torque_of_a_turn_within_a_sample_is_foreseen(free, sample_s):
    """The closed form of a ramp, against a diffusion that has not reached the tip: within 15 %."""
    held = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=100.0, free_mm=free)
    time = np.linspace(0, sample_s, 41)
    turned = ramp(time, by=math.radians(3.0), duration_s=sample_s)
    torque = held.respond(time, turned, count=200).base_torque_n_mm[-1]
    assert 3.0 * GENTLE.stiffness_n_mm_per_deg(free, sample_s) == pytest.approx(torque, rel=0.15)


def test_a_turn_ends_where_the_shear_stress_would_pass_its_limit():
    base = LimitedBase(MotorLimits(shaft=GENTLE))
    base.toward(0.0, sample(), Status.OK)
    at = NITINOL.torque_n_mm_at(100.0) - 0.2
    pushed = base.toward(90.0, sample(0.002, torque=at), Status.OK)
    assert pushed.torque_limited
    assert pushed.base_deg == pytest.approx(0.2 / GENTLE.stiffness_n_mm_per_deg(50.0, 0.002))
    assert base.toward(90.0, sample(0.004, torque=at + 0.3), Status.OK).base_deg == pushed.base_deg
    back = base.toward(-90.0, sample(0.006, torque=at + 0.3), Status.OK)
    assert (back.base_deg, back.torque_limited) == (pushed.base_deg - 3.0, False)


def test_what_was_commanded_but_is_not_shown_yet_counts_as_torque_to_come():
    """The sensor shows nothing for 40 ms: the base goes no further than the limit over k."""
    late = GENTLE.but(lateness_s=0.04)
    base = LimitedBase(MotorLimits(shaft=late))
    commands = [base.toward(90.0, sample(0.002 * i), Status.OK) for i in range(20)]
    most = late.torque_n_mm / late.stiffness_n_mm_per_deg(50.0, 0.042)
    assert commands[-1].base_deg == pytest.approx(most)
    assert commands[-1].torque_limited
    # As soon as the torque of the first commands is known to be none, they no longer count.
    assert base.toward(90.0, sample(0.06), Status.OK).base_deg > 1.3 * most
    # Negative control: a limit that takes the torque for what it is now goes on.
    prompt = LimitedBase(MotorLimits(shaft=GENTLE))
    assert [prompt.toward(90.0, sample(0.002 * i), Status.OK) for i in range(20)][-1].base_deg > most


def test_the_weaker_of_motor_and_shaft_limits_the_torque():
    assert MotorLimits(torque_n_mm=2.0, shaft=GENTLE).most_torque_n_mm == 2.0
    limited = MotorLimits(shaft=GENTLE).most_torque_n_mm
    assert NITINOL.shear_stress_mpa(limited) == pytest.approx(100.0)
    assert MotorLimits().most_torque_n_mm == 20.0
