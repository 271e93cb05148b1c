"""Newton's method: one step where the balance is linear, a solution where it is not, or an honest no."""

import math

import numpy as np
import pytest

from validation.rig.balance import linearise
from validation.rig.newton import TOLERANCE, solve
from validation.rig.state import StepInput


def left(made):
    return linearise(made.law, made.chain, made.state, made.inputs, made.work, False)


def run(made):
    return solve(made.law, made.chain, made.state, made.inputs, made.work)


def test_without_friction_the_whole_needle_follows_the_base(step):
    made = step(base=0.35, damping=0.0)
    assert run(made)
    assert made.work.angle == pytest.approx(0.35, abs=1e-12)


@pytest.mark.parametrize(
    "law",
    [
        {},
        {"exponent": 0.4},
        {"coulomb": 0.004, "entry": 0.1},
        {"hardening": 1e5},
        {"kinetic": 0.002, "static": 0.003, "stribeck": 0.4},
        {"compliance": 20.0, "retardation": 0.5, "half_gap": 0.02},
    ],
)
def test_a_solution_balances_all_torques(step, law):
    """What an angle error of the tolerance leaves: the stiffest link times it, on every node."""
    made = step(base=0.35, **law)
    assert left(made) > 0.1
    assert run(made)
    largest = np.abs(made.work.diagonal).max()
    assert left(made) <= 2 * largest * TOLERANCE * made.work.angle.size


def test_no_solution_is_reported_where_numbers_are_lost(step):
    made = step(base=0.35)
    made.inputs = StepInput(math.nan, 0.0, 100.0, 0.0, 0.0, 0.0)
    assert not run(made)
