"""A shaft whose stiffness depends on the torque that it carries: a nonlinear elastic spring.

    torque = k f(k twist) twist

k being the nominal stiffness of an element. log f runs straight between places of sqrt(torque), level
beyond the last one, with a curve of its own for either sign. With s the slope of log f from one place
to the next, and p the place, the slope of the torque is

    d torque / d twist = k f (1 + s p / 2).
"""

import math

from sim.kernel import memory_map
from sim.kernel.compiled import Array, inlined
from sim.kernel.stage.workspace import Workspace

_LEAST_SLOPE = 0.05  # of the torque over its secant: where a shaft gives way, the matrix stays positive


@inlined
def _twist(w: Workspace, g: float, e: int) -> float:
    """Twist of an element at the end of the stage, from its node near the base on, rad."""
    return w.theta[e] - w.theta[e + 1] + g * (w.omega[e] - w.omega[e + 1])


@inlined
def stiffness_factor(head: Array, torque: float) -> tuple[float, float]:
    """f, and d log f / d log torque, at a torque of the nominal stiffness, N m."""
    last = memory_map.STIFFNESS_POINTS - 1
    at = last * math.sqrt(abs(torque) / head[memory_map.H_STIFFNESS_TORQUE])
    first = memory_map.H_STIFFNESS_0 + (memory_map.STIFFNESS_POINTS if torque > 0.0 else 0)
    if at >= last:
        return math.exp(head[first + last]), 0.0
    i = int(at)
    slope = head[first + i + 1] - head[first + i]
    return math.exp(head[first + i] + (at - i) * slope), 0.5 * slope * at


@inlined
def set_springs(head: Array, w: Workspace, g: float) -> None:
    """Stiffness of the elements, torque over twist, where the rates stand."""
    for e in range(w.set.size):
        factor, _ = stiffness_factor(head, w.nominal[e] * _twist(w, g, e))
        w.spring[e] = factor * w.nominal[e]


@inlined
def add_stiffening(head: Array, w: Workspace, g: float) -> None:
    """What the slope of the torque is more than the stiffness, in the matrix of the stage equation."""
    lower, diagonal, upper = w.lower, w.diagonal, w.upper
    for e in range(w.set.size):
        _, rise = stiffness_factor(head, w.nominal[e] * _twist(w, g, e))
        more = g * w.spring[e] * max(rise, _LEAST_SLOPE - 1.0)
        diagonal[e] += more
        diagonal[e + 1] += more
        upper[e] -= more
        lower[e + 1] -= more
