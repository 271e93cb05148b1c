"""A shaft that yields, creeps or has a joint: elements that keep a twist without a torque.

    torque = k (twist - set),    |torque - k q / (1 - q) set| <= yield torque,

k being the stiffness of an element and q k that beyond yielding: linear kinematic hardening. In each
stage the set at its end is that of the twist there (return mapping; Simo and Hughes, Computational
Inelasticity, section 1.4). Or, as a standard linear solid,

    d set / dt = (c torque / k - set) / tau,

so that a torque twists the shaft 1 + c times as far in the end. Or a joint has play: its set is any
within that, so that it carries no torque inside.
"""

import math

from sim.kernel.compiled import Array, inlined
from sim.kernel.stage.workspace import Frame, Workspace

_IN_PLAY = 1.0 - 1e-6  # part of the stiffness that an element loses there: the equation stays solvable


@inlined
def _hardening(stiffness: float, slope: float) -> float:
    """Rise of the torque that an element yields at, over its set, N m / rad."""
    return stiffness * slope / (1.0 - slope)


@inlined
def set_after(stiffness: float, frame: Frame, twist: float, before: float) -> float:
    """The set of an element at a twist, rad, from that before."""
    hardening = _hardening(stiffness, frame.yield_slope)
    driving = stiffness * (twist - before) - hardening * before
    excess = abs(driving) - frame.yield_torque
    if excess <= 0.0:
        return before
    return before + math.copysign(excess / (stiffness + hardening), driving)


@inlined
def crept_after(frame: Frame, twist: float, before: float) -> tuple[float, float]:
    """The set of an element that creeps at a twist, rad, from that before, and its slope."""
    share = frame.g / frame.creep_time
    slope = share * frame.creep / (1.0 + share * (1.0 + frame.creep))
    return before / (1.0 + share * (1.0 + frame.creep)) + slope * twist, slope


@inlined
def play_of(frame: Frame, e: int) -> float:
    """Half of the play in an element, rad: a joint between the middles of two is shared by them."""
    return frame.joint * max(0.0, 1.0 - abs(frame.joint_at - e))


@inlined
def add_sets(w: Workspace, frame: Frame) -> None:
    """What sets change of the linearised stage equation: torques of the elements, and their slopes."""
    rhs, lower, diagonal, upper = w.rhs, w.lower, w.diagonal, w.upper
    theta, omega, spring = w.theta, w.omega, w.spring
    for e in range(w.set.size):
        twist = theta[e + 1] - theta[e] + frame.g * (omega[e + 1] - omega[e])
        slope = 0.0
        if frame.joint > 0.0:
            play = play_of(frame, e)
            w.set[e] = min(max(twist, -play), play)
            slope = _IN_PLAY if abs(twist) < play else 0.0
        elif frame.creep > 0.0:
            w.set[e], slope = crept_after(frame, twist, w.set_before[e])
        else:
            w.set[e] = set_after(spring[e], frame, twist, w.set_before[e])
            if w.set[e] != w.set_before[e]:
                slope = 1.0 - frame.yield_slope
        torque = spring[e] * w.set[e]
        rhs[e] -= torque
        rhs[e + 1] += torque
        if slope > 0.0:
            softer = frame.g * spring[e] * slope
            diagonal[e] -= softer
            diagonal[e + 1] -= softer
            upper[e] += softer
            lower[e + 1] += softer


@inlined
def hold_sets(w: Workspace, sets: Array) -> None:
    """The first stage starts from the sets of the step."""
    for e in range(sets.size):
        w.set[e] = w.set_before[e] = sets[e]


@inlined
def carry_sets(w: Workspace, sets: Array, kept: float, carried: float) -> None:
    """Where the next stage starts (sim.kernel.method)."""
    for e in range(sets.size):
        before = w.set_before[e]
        w.set_before[e] = sets[e] + kept * (before - sets[e]) + carried * (w.set[e] - before)


@inlined
def keep_sets(w: Workspace, frame: Frame, h: float, sets: Array, after: Array) -> tuple[float, float]:
    """Write the sets at the end of the step; returns heat and energy stored beside the twist, J."""
    heat, stored = 0.0, 0.0
    for e in range(sets.size):
        after[e] = w.set[e]
        change = after[e] - sets[e]
        rise = _hardening(w.spring[e], frame.yield_slope)
        if frame.creep > 0.0:
            rise = w.spring[e] / frame.creep
            heat += rise * frame.creep_time * change * change / h
        else:
            heat += frame.yield_torque * abs(change)
        stored += 0.5 * rise * after[e] * after[e]
    return heat, stored
