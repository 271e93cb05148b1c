"""Newton's method on one step in time of the reference simulation."""

from __future__ import annotations

import math

import numpy as np
from reference_balance import State, Step
from reference_laws import Array

NEWTON_TOLERANCE_RAD = 1e-10
DESCENTS = 20


def solved(step: Step) -> State | None:
    """The state at the end of the step: by full Newton steps, else by damped ones, else by descent.

    Friction that falls faster with the slip rate than viscous torque rises has several balances.
    Without its falling slope, the steps descend to a stable one.
    """
    for most_halvings, most_iterations in ((0, 20), (6, 40)):
        found, angle, twist = iterated(step, *step.guess, most_halvings, most_iterations)
        if found:
            return step.finished(angle, twist)
    angle, twist = step.guess
    for _ in range(DESCENTS):
        _, angle, twist = iterated(step, angle, twist, 0, 40, steepest_fall=0.0)
        found, near_angle, near_twist = iterated(step, angle, twist, 0, 15)
        if found:
            return step.finished(near_angle, near_twist)
    return None


def iterated(
    step: Step,
    angle: Array,
    twist: Array,
    halvings: int,
    iterations: int,
    steepest_fall: float = math.inf,
) -> tuple[bool, Array, Array]:
    """Newton steps from there, and whether they have converged."""
    step.steepest_fall = steepest_fall
    for _ in range(iterations):
        linear = step.linearised(angle, twist)
        turn, more_twist = linear.solve()
        part = helpful_part(step, angle, twist, turn, more_twist, linear.mismatch(), halvings)
        angle, twist = angle + part * turn, twist + part * more_twist
        change = max(np.abs(turn).max(), np.abs(more_twist).max())
        if change < NEWTON_TOLERANCE_RAD or not np.isfinite(change):
            return bool(np.isfinite(change)), angle, twist
    return False, angle, twist


def helpful_part(
    step: Step,
    angle: Array,
    twist: Array,
    turn: Array,
    more_twist: Array,
    mismatch: float,
    halvings: int,
) -> float:
    """The part of a Newton step that reduces the mismatch."""
    part = 1.0
    for _ in range(halvings):
        if step.linearised(angle + part * turn, twist + part * more_twist).mismatch() < mismatch:
            break
        part /= 2
    return part
