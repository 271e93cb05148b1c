"""Newton's method for the balance of torques.

It is semismooth: kinks of dry friction and backlash give one of their slopes. If full steps do not
settle, steps are halved until the mismatch falls. Friction that falls with the slip rate faster than
viscous torque rises may have several balances, or jump between them: then the level is taken at
frozen slip rates, and these follow the solution until Newton's method settles from there. If it never
does, the level lags a little behind the rate for that step.
"""

import math

from numba import njit

from validation.rig.balance import linearise, slip_rate
from validation.rig.laws import Law
from validation.rig.mesh import Layout
from validation.rig.state import Push, State, Work

TOLERANCE = 1e-7
"""It rests when no angle moves by more, rad."""
THAWS = 12


@njit(cache=True)
def solve(law: Law, lay: Layout, state: State, push: Push, work: Work) -> bool:
    """Find angles and twists from the guess in `work`; whether they were found."""
    angle, twist = work.angle.copy(), work.twist.copy()
    for halvings, iterations in ((0, 12), (8, 60)):
        if _iterate(law, lay, state, push, work, (halvings, iterations), False):
            return True
        work.angle[:], work.twist[:] = angle, twist
    return law.static > law.kinetic and _thaw(law, lay, state, push, work)


@njit(cache=True)
def _thaw(law: Law, lay: Layout, state: State, push: Push, work: Work) -> bool:
    for attempt in range(THAWS):
        for i in range(work.angle.size):
            work.frozen[i] = slip_rate(push, work, i)
        if not _iterate(law, lay, state, push, work, (8 if attempt % 2 else 0, 60), True):
            return False
        angle, twist = work.angle.copy(), work.twist.copy()
        if _iterate(law, lay, state, push, work, (0, 10), False):
            return True
        work.angle[:], work.twist[:] = angle, twist
    return True


@njit(cache=True)
def _iterate(
    law: Law, lay: Layout, state: State, push: Push, work: Work, most: tuple[int, int], frozen: bool
) -> bool:
    """Newton steps; `most`: halvings of each, and how many."""
    for _ in range(most[1]):
        mismatch = linearise(law, lay, state, push, work, frozen)
        largest = _step(work)
        _move(work, 1.0)
        if largest < TOLERANCE:
            return True
        if not math.isfinite(largest):
            return False
        if most[0] > 0:
            _shorten(law, lay, state, push, work, mismatch, most[0], frozen)
    return False


@njit(cache=True)
def _step(work: Work) -> float:
    """Solve the rows for the turn of nodes (Thomas' algorithm); returns the largest move."""
    nodes = work.angle.size
    turn, own, force = work.turn, work.own, work.force
    for i in range(1, nodes):
        factor = work.lower[i] / own[i - 1]
        own[i] -= factor * work.upper[i - 1]
        force[i] -= factor * force[i - 1]
    turn[nodes - 1] = force[nodes - 1] / own[nodes - 1]
    for i in range(nodes - 2, -1, -1):
        turn[i] = (force[i] - work.upper[i] * turn[i + 1]) / own[i]
    largest = 0.0
    for i in range(nodes):
        work.twist_force[i] += work.twist_gain[i] * turn[i]
        largest = max(largest, abs(turn[i]), abs(work.twist_force[i]))
        if not math.isfinite(turn[i]):
            return math.inf
    return largest


@njit(cache=True)
def _move(work: Work, part: float) -> None:
    for i in range(work.angle.size):
        work.angle[i] += part * work.turn[i]
        work.twist[i] += part * work.twist_force[i]


@njit(cache=True)
def _shorten(
    law: Law,
    lay: Layout,
    state: State,
    push: Push,
    work: Work,
    mismatch: float,
    halvings: int,
    frozen: bool,
) -> None:
    """Take back half of the move again and again until the mismatch is smaller than before it."""
    turn, twist_turn = work.turn.copy(), work.twist_force.copy()
    part = 1.0
    for _ in range(halvings):
        if linearise(law, lay, state, push, work, frozen) < mismatch:
            return
        part /= 2.0
        work.angle[:] -= part * turn
        work.twist[:] -= part * twist_turn
