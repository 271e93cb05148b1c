"""Newton's method for the balance of torques.

It is semismooth: at kinks of dry friction and backlash it uses one of the two slopes. If full steps
do not converge, a line search halves them until the residual falls. Friction that falls faster with
the slip rate than viscous torque rises may have several balances, or jump between them: then the level
is taken at lagged slip rates, which follow the solution (a fixed-point iteration) until Newton's method
converges from there. If it never does, the level lags slightly behind the rate in that step.
"""

import math

from numba import njit

from validation.rig.balance import linearise, slip_rate
from validation.rig.laws.parameters import LawParameters
from validation.rig.mesh import CellChain
from validation.rig.state import NewtonWorkspace, RigState, StepInput

TOLERANCE = 1e-7
"""Converged when no angle moves by more, rad."""
LAGGED_ATTEMPTS = 12


@njit(cache=True)
def solve(
    law: LawParameters, chain: CellChain, state: RigState, inputs: StepInput, work: NewtonWorkspace
) -> bool:
    """Find angles and twists from the guess in `work`; returns whether they were found."""
    angle, twist = work.angle.copy(), work.twist.copy()
    for halvings, iterations in ((0, 12), (8, 60)):
        if _iterate(law, chain, state, inputs, work, (halvings, iterations), False):
            return True
        work.angle[:], work.twist[:] = angle, twist
    return law.static > law.kinetic and _solve_with_lagged_rates(law, chain, state, inputs, work)


@njit(cache=True)
def _solve_with_lagged_rates(
    law: LawParameters, chain: CellChain, state: RigState, inputs: StepInput, work: NewtonWorkspace
) -> bool:
    for attempt in range(LAGGED_ATTEMPTS):
        for i in range(work.angle.size):
            work.lagged_rate[i] = slip_rate(inputs, work, i)
        if not _iterate(law, chain, state, inputs, work, (8 if attempt % 2 else 0, 60), True):
            return False
        angle, twist = work.angle.copy(), work.twist.copy()
        if _iterate(law, chain, state, inputs, work, (0, 10), False):
            return True
        work.angle[:], work.twist[:] = angle, twist
    return True


@njit(cache=True)
def _iterate(
    law: LawParameters,
    chain: CellChain,
    state: RigState,
    inputs: StepInput,
    work: NewtonWorkspace,
    most: tuple[int, int],
    lagged: bool,
) -> bool:
    """Newton's iteration; returns whether it converged.

    Args:
      most: largest number of halvings of each step, and of steps.
      lagged: take the dry level at `work.lagged_rate`.
    """
    for _ in range(most[1]):
        residual_norm = linearise(law, chain, state, inputs, work, lagged)
        largest = _solve_tridiagonal(work)
        _update(work, 1.0)
        if largest < TOLERANCE:
            return True
        if not math.isfinite(largest):
            return False
        if most[0] > 0:
            _backtrack(law, chain, state, inputs, work, residual_norm, most[0], lagged)
    return False


@njit(cache=True)
def _solve_tridiagonal(work: NewtonWorkspace) -> float:
    """Solve the rows for the increments (Thomas' algorithm); returns the largest, rad."""
    nodes = work.angle.size
    increment, diagonal, residual = work.increment, work.diagonal, work.residual
    for i in range(1, nodes):
        factor = work.lower[i] / diagonal[i - 1]
        diagonal[i] -= factor * work.upper[i - 1]
        residual[i] -= factor * residual[i - 1]
    increment[nodes - 1] = residual[nodes - 1] / diagonal[nodes - 1]
    for i in range(nodes - 2, -1, -1):
        increment[i] = (residual[i] - work.upper[i] * increment[i + 1]) / diagonal[i]
    largest = 0.0
    for i in range(nodes):
        work.twist_increment[i] += work.twist_gain[i] * increment[i]
        largest = max(largest, abs(increment[i]), abs(work.twist_increment[i]))
        if not math.isfinite(increment[i]):
            return math.inf
    return largest


@njit(cache=True)
def _update(work: NewtonWorkspace, part: float) -> None:
    for i in range(work.angle.size):
        work.angle[i] += part * work.increment[i]
        work.twist[i] += part * work.twist_increment[i]


@njit(cache=True)
def _backtrack(
    law: LawParameters,
    chain: CellChain,
    state: RigState,
    inputs: StepInput,
    work: NewtonWorkspace,
    residual_norm: float,
    halvings: int,
    lagged: bool,
) -> None:
    """Line search: take back half of the step repeatedly until the residual has fallen."""
    increment, twist_increment = work.increment.copy(), work.twist_increment.copy()
    part = 1.0
    for _ in range(halvings):
        if linearise(law, chain, state, inputs, work, lagged) < residual_norm:
            return
        part /= 2.0
        work.angle[:] -= part * increment
        work.twist[:] -= part * twist_increment
