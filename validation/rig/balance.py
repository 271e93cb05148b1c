"""The balance of torques at the end of one step in time, and its solution.

Every node: torque from the chuck's side - torque to the tip's side = friction on it. The twist of the
tissue follows the interface torque, twist = softness' torque - memory' past, and is condensed node by
node, so that each step of Newton's method solves one tridiagonal system for the angles.
"""

import math

from numba import njit

from validation.rig.laws import Law, interface, preslide
from validation.rig.mesh import Layout
from validation.rig.state import CHUCK, ENTRY, TIP, Push, State, Work


@njit(cache=True)
def chuck(law: Law, lay: Layout, state: State, base: float, first: float) -> tuple[float, float, float]:
    """Torque of the drive on the needle, its slope with the stretch, and how far the chuck slips."""
    stiffness = 1.0 / (1.0 / lay.link[0] + law.base_softness)
    stretch = base - state.lumped[CHUCK] - first
    elastic = stretch - min(max(stretch, -law.half_gap), law.half_gap)
    torque, slope = _spring(law, stiffness, lay.link_mm[0], elastic)
    if abs(torque) > law.grip:
        held = math.copysign(law.grip, torque)
        return held, 0.0, (torque - held) / stiffness
    return torque, slope if abs(stretch) >= law.half_gap else 0.0, 0.0


@njit(cache=True)
def _spring(law: Law, stiffness: float, length: float, twist: float) -> tuple[float, float]:
    strain = twist / length
    more = law.hardening * strain * strain
    return stiffness * twist * (1.0 + more), stiffness * (1.0 + 3.0 * more)


@njit(cache=True)
def linearise(law: Law, lay: Layout, state: State, push: Push, work: Work, frozen: bool) -> float:
    """Fill the rows of a Newton step at the sought angles and twists; returns the mismatch.

    Args:
      frozen: take the dry level at the frozen slip rates, which makes the balance monotone.
    """
    _add_shaft(law, lay, state, push, work)
    _add_interface(law, lay, state, push, work, frozen)
    _add_dry_and_bend(law, lay, state, work)
    _add_entry(law, lay, state, work)
    _add_tip(law, state, push, work)
    total = 0.0
    for i in range(work.angle.size):
        total += work.force[i] ** 2 + work.twist_force[i] ** 2
    return float(math.sqrt(total))


@njit(cache=True)
def _add_shaft(law: Law, lay: Layout, state: State, push: Push, work: Work) -> None:
    nodes = work.angle.size
    torque, slope, _ = chuck(law, lay, state, push.base, work.angle[0])
    for i in range(nodes):
        next_torque, next_slope = 0.0, 0.0
        if i + 1 < nodes:
            twist = work.angle[i] - work.angle[i + 1]
            next_torque, next_slope = _spring(law, lay.link[i + 1], lay.link_mm[i + 1], twist)
        work.force[i] = torque - next_torque
        work.lower[i], work.own[i], work.upper[i] = -slope, slope + next_slope, -next_slope
        torque, slope = next_torque, next_slope


@njit(cache=True)
def slip_rate(push: Push, work: Work, i: int) -> float:
    """Of the shaft against the tissue at a node."""
    return float(push.lead * (work.angle[i] - work.twist[i]) + work.angle_past[i] - work.twist_past[i])


@njit(cache=True)
def _add_interface(law: Law, lay: Layout, state: State, push: Push, work: Work, frozen: bool) -> None:
    slowing = 1.0 + law.retardation * push.lead
    for i in range(work.angle.size):
        if lay.tissue[i] == 0.0:
            work.torque[i] = work.twist_force[i] = work.twist_gain[i] = work.twist[i] = 0.0
            continue
        turn = work.angle[i] - state.angle[i]
        rate = slip_rate(push, work, i)
        slip = (rate, turn - work.twist[i] + work.twist_now[i], push.axial_travel)
        before = (state.presliding[i], state.turning[i], state.axial[i], state.age[i])
        damping = lay.damping[i]
        if law.worn_share > 0.0:
            damping *= 1.0 - law.worn_share * (1.0 - math.exp(-state.worn[i] / law.worn_angle))
        torque, per_rate, per_travel = interface(
            law, damping, before, slip, work.frozen[i] if frozen else rate
        )
        per_turn = push.lead * per_rate + per_travel
        softness = law.softness / slowing
        relief = 1.0 / (1.0 + softness * per_turn)
        wanted = softness * torque - law.retardation / slowing * work.twist_past[i]
        work.torque[i] = torque
        work.twist_force[i] = (wanted - work.twist[i]) * relief if law.softness > 0.0 else 0.0
        work.twist_gain[i] = softness * per_turn * relief
        work.force[i] -= lay.tissue[i] * (torque - per_turn * work.twist_force[i])
        work.own[i] += lay.tissue[i] * per_turn * relief


@njit(cache=True)
def _add_dry_and_bend(law: Law, lay: Layout, state: State, work: Work) -> None:
    if law.sheath == 0.0 and law.curvature == 0.0:
        return
    for i in range(work.angle.size):
        z, gain = preslide(law.limit, state.sheath[i], work.angle[i] - state.angle[i])
        rub = lay.sheath[i] * law.sheath / law.limit
        bend, lean = lay.tissue[i] * law.curvature, work.angle[i] - law.phase
        work.force[i] -= rub * z + bend * math.sin(lean)
        work.own[i] += rub * gain + bend * math.cos(lean)


@njit(cache=True)
def passed(lay: Layout, state: State, work: Work) -> float:
    """How far the shaft turns where it enters."""
    travel = 0.0
    for i in range(work.angle.size):
        if lay.passing[i] > 0.0:
            travel += lay.passing[i] * (work.angle[i] - state.angle[i])
    return travel


@njit(cache=True)
def _add_entry(law: Law, lay: Layout, state: State, work: Work) -> None:
    if law.entry == 0.0:
        return
    z, gain = preslide(law.limit, state.lumped[ENTRY], passed(lay, state, work))
    for i in range(work.angle.size):
        if lay.entry[i] > 0.0:
            level = law.entry * lay.entry[i] / law.limit
            work.force[i] -= level * z
            work.own[i] += level * gain * lay.passing[i]
            if i > 0:
                work.lower[i] += level * gain * lay.passing[i - 1]
            if i + 1 < work.angle.size:
                work.upper[i] += level * gain * lay.passing[i + 1]


@njit(cache=True)
def _add_tip(law: Law, state: State, push: Push, work: Work) -> None:
    last = work.angle.size - 1
    level = law.load * abs(push.tip_torque) / law.limit
    z, gain = preslide(law.limit, state.lumped[TIP], work.angle[last] - state.angle[last])
    rate = push.lead * work.angle[last] + work.angle_past[last]
    work.force[last] -= push.tip_torque + law.tip_drag * rate + level * z
    work.own[last] += law.tip_drag * push.lead + level * gain
