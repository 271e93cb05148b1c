"""Newton's method on one stage, with a line search: dry friction has corners.

The residual is, up to sign, the gradient of a potential, which is convex wherever friction
does not weaken with speed. Most stages need a few steps. If more are taken, Newton's
method may be going round in a circle: a step that meets a good part of the force that it
set out with has overshot the minimum along it, which regula falsi then finds. Where friction
weakens so fast that the potential is concave, the needle snaps to another state: negative
pivots count as positive, so that every step descends (Nocedal and Wright, Numerical
Optimization, section 3.4), and one at whose end the force still pulls goes on.
"""

import math
from typing import NamedTuple

from sim.kernel import memory_map
from sim.kernel.compiled import Array, inlined
from sim.kernel.stage.assemble import (
    add_linear,
    add_row,
    add_viscous_advection,
    is_linear,
)
from sim.kernel.stage.chuck import drive_torque
from sim.kernel.stage.plasticity import add_sets
from sim.kernel.stage.stiffening import add_stiffening, set_springs
from sim.kernel.stage.tridiagonal import factorise, substitute
from sim.kernel.stage.workspace import Frame, Workspace

_TOLERANCE = 1e-10  # change of a rate in the last iteration, relative above 1 rad/s
_BALANCE = 1e-12  # torque over slope that is as good as none, as a change of a rate, like _TOLERANCE
_FREE = 4  # steps that are not searched: a drive crosses its play in three
_OVERSHOOT = 0.3  # a step is shortened where it meets this much of its own force again
_STILL = 0.5  # a step is lengthened where so much of its force still pulls ahead
_LONGER, _LONGEST = 4.0, 1e6  # by which factor, and up to how many times Newton's step
_ITERATIONS = 160


@inlined
def _add_other_rows(law: Array, w: Workspace, frame: Frame, tip_torque: float) -> tuple[float, float]:
    recoverable, stored = 0.0, 0.0
    for r in range(law.shape[0]):
        if is_linear(law[r]):
            if frame.drift != 0.0 and law[r, memory_map.L_VISCOUS] != 0.0:
                add_viscous_advection(w, w.loads[r], law[r, memory_map.L_VISCOUS], frame)
        else:
            power, energy = add_row(w, r, law[r], frame, tip_torque)
            recoverable += power
            stored += energy
    return recoverable, stored


class Search(NamedTuple):
    """A line search along Newton's step, between fractions of it."""

    force: float  # along the step, where it set out
    low: float  # fraction up to which the force still pulls ahead
    pull: float  # force there, halved each time that this end stays
    high: float  # fraction at which the force pushes back
    push: float  # force there; 0: not met yet
    at: float  # fraction where the rates stand


@inlined
def newton(
    head: Array,
    law: Array,
    w: Workspace,
    frame: Frame,
    drive: float,
    tip_torque: float,
    nonlinear: bool,
    factored: bool,
    slip: float = 0.0,
) -> tuple[bool, int, float, float]:
    """Solve one stage for the rates `w.omega`, rad/s, from where they stand.

    Without nonlinear rows all stages have the same matrix, and one iteration is
    exact: the later stages use the factors of the first.

    Args:
      head: numeric field of the model.
      law: (rows, columns).
      drive: angle at which the servo rests, rad, or a torque on the first node, N m.
      tip_torque: torque that resists at the tip, N m.
      nonlinear: whether iteration is needed.
      factored: whether the factors of the stage before hold.
      slip: of the chuck before the stage, rad; `drive` is less it.

    Returns:
      whether it converged, iterations, power that goes into twisted tissue and bent shaft, W, and
      energy stored in the tissue, J.
    """
    rhs, diagonal = w.rhs, w.diagonal
    n = rhs.size
    recoverable, stored, convex = 0.0, 0.0, True
    search = Search(0.0, 0.0, 0.0, 1.0, 0.0, 1.0)
    stiffens = head[memory_map.H_STIFFNESS_TORQUE] > 0.0
    for iteration in range(_ITERATIONS):
        if stiffens:
            set_springs(head, w, frame.g)
        add_linear(w, frame.g, not factored)
        if stiffens:
            add_stiffening(head, w, frame.g)
        torque, slope = drive_torque(w, frame, drive, slip)
        rhs[0] += torque
        rhs[n - 1] -= tip_torque
        if not factored:
            diagonal[0] += slope
            if frame.yield_torque > 0.0 or frame.creep > 0.0 or frame.joint > 0.0:
                add_sets(w, frame)
            recoverable, stored = _add_other_rows(law, w, frame, tip_torque)
        if iteration > _FREE or not convex:
            searching, search = _search(w, search)
            if searching:
                continue
        if nonlinear and iteration > 0 and _balanced(w):
            return True, iteration, recoverable, stored
        if not factored:
            convex = factorise(w.lower, w.diagonal, w.upper)
        change, size, force = _take_step(w)
        search = Search(force, 0.0, force, 1.0, 0.0, 1.0)
        if not math.isfinite(change + force):  # of NaN, `max` keeps the other
            return False, iteration + 1, recoverable, stored
        if not nonlinear or change <= _TOLERANCE * size:
            return True, iteration + 1, recoverable, stored
    return False, _ITERATIONS, recoverable, stored


@inlined
def _search(w: Workspace, search: Search) -> tuple[bool, Search]:
    """Move along the last step if its end is far from the minimum along it.

    Where the end of a step meets a good part of the force that it set out with, the minimum
    along it lies before: regula falsi with Illinois' halving, until little force is left. Where
    a good part of that force still pulls ahead, it lies beyond.
    Returns whether the rates have moved.
    """
    rhs, step, omega = w.rhs, w.step, w.omega
    n = omega.size
    met, length = 0.0, 0.0
    for i in range(n):
        met += rhs[i] * step[i]
        length = max(length, abs(step[i]))
    low, pull, high, push = search.low, search.pull, search.high, search.push
    still = met > _STILL * search.force and push == 0.0 and search.at < _LONGEST
    calm = abs(met) <= _OVERSHOOT * search.force or (met > 0.0 and push == 0.0)
    if not still and (calm or (high - low) * length <= _TOLERANCE):
        return False, search
    if met > 0.0:
        low, pull, push = search.at, met, 0.5 * push
    else:
        pull = 0.5 * pull if push > 0.0 else pull
        high, push = search.at, -met
    if still:
        high = at = _LONGER * low
    else:
        at = low + (high - low) * pull / (pull + push)
    for i in range(n):
        omega[i] += (at - search.at) * step[i]
    return True, Search(search.force, low, pull, high, push, at)


@inlined
def _balanced(w: Workspace) -> bool:
    """Whether so little force is left that another step would only confirm the last."""
    rhs, diagonal, omega = w.rhs, w.diagonal, w.omega
    for i in range(omega.size):
        if abs(rhs[i]) > _BALANCE * diagonal[i] * max(1.0, abs(omega[i])):
            return False
    return True


@inlined
def _take_step(w: Workspace) -> tuple[float, float, float]:
    """Take Newton's step; returns the largest change of a rate, the largest rate (1 rad/s at least),
    and the force along the step."""
    step, rhs, omega = w.step, w.rhs, w.omega
    n = omega.size
    for i in range(n):
        step[i] = rhs[i]
    substitute(w.lower, w.diagonal, w.upper, w.step)
    change, size, force = 0.0, 1.0, 0.0
    for i in range(n):
        omega[i] += step[i]
        force += rhs[i] * step[i]
        change = max(change, abs(step[i]))
        size = max(size, abs(omega[i]))
    return change, size, force
