"""The balance of torques at the end of one step in time, and its linearisation.

For every node, torque from the chuck's side - torque to the tip's side = friction on it. The twist of
the tissue follows from the interface torque, with compliance c, retardation time r and hardening h:

    (1 + r lead) twist + h twist^3 = c torque - r past,

and is eliminated node by node, so that each step of Newton's method solves one tridiagonal system for
the angles.
"""

import math

from numba import njit

from validation.rig.laws.interface import damping_share, dry_share, interface, preslide
from validation.rig.laws.parameters import LawParameters
from validation.rig.laws.shaft import chuck_torque, link_torque
from validation.rig.laws.tissue import tissue_compliance
from validation.rig.mesh import CellChain
from validation.rig.state import ENTRY, TIP, NewtonWorkspace, RigState, StepInput


@njit(cache=True)
def linearise(
    law: LawParameters,
    chain: CellChain,
    state: RigState,
    inputs: StepInput,
    work: NewtonWorkspace,
    lagged: bool,
) -> float:
    """Fill the rows of a Newton step at the present angles and twists; returns the norm of the residual.

    Args:
      lagged: take the dry level at the lagged slip rates, which makes the balance monotone.
    """
    _add_shaft(law, chain, state, inputs, work)
    _add_interface(law, chain, state, inputs, work, lagged)
    _add_sheath_and_curvature(law, chain, state, work)
    _add_entry(law, chain, state, work)
    _add_tip(law, state, inputs, work)
    total = 0.0
    for i in range(work.angle.size):
        total += work.residual[i] ** 2 + work.twist_increment[i] ** 2
    return float(math.sqrt(total))


@njit(cache=True)
def _add_shaft(
    law: LawParameters, chain: CellChain, state: RigState, inputs: StepInput, work: NewtonWorkspace
) -> None:
    nodes = work.angle.size
    torque, slope, _ = chuck_torque(law, chain, state, inputs.base, work.angle[0])
    for i in range(nodes):
        next_torque, next_slope = 0.0, 0.0
        if i + 1 < nodes:
            twist = work.angle[i] - work.angle[i + 1]
            next_torque, next_slope = link_torque(law, chain, state, i + 1, twist)
        work.residual[i] = torque - next_torque
        work.lower[i], work.diagonal[i], work.upper[i] = -slope, slope + next_slope, -next_slope
        torque, slope = next_torque, next_slope


@njit(cache=True)
def slip_rate(inputs: StepInput, work: NewtonWorkspace, i: int) -> float:
    """Slip rate of the shaft against the tissue at a node, rad/s."""
    return float(inputs.lead * (work.angle[i] - work.twist[i]) + work.angle_past[i] - work.twist_past[i])


@njit(cache=True)
def _add_interface(
    law: LawParameters,
    chain: CellChain,
    state: RigState,
    inputs: StepInput,
    work: NewtonWorkspace,
    lagged: bool,
) -> None:
    for i in range(work.angle.size):
        if chain.tissue[i] == 0.0:
            work.torque[i] = work.twist_increment[i] = work.twist_gain[i] = work.twist[i] = 0.0
            continue
        turn = work.angle[i] - state.angle[i]
        rate = slip_rate(inputs, work, i)
        slip = (rate, turn - work.twist[i] + work.twist_now[i], inputs.axial_travel)
        before = (state.presliding[i], state.turning[i], state.axial[i], state.age[i])
        damping = chain.damping[i] * damping_share(law, state.worn[i], inputs.time)
        level_share = dry_share(law, chain.depth[i], inputs.speed)
        torque, per_rate, per_travel = interface(
            law, damping, before, slip, work.lagged_rate[i] if lagged else rate, level_share
        )
        per_turn = inputs.lead * per_rate + per_travel
        harder = law.tissue_hardening * work.twist[i] ** 2
        retarded = 1.0 + law.retardation * inputs.lead + 3.0 * harder
        compliance = tissue_compliance(law, inputs.time, chain.depth[i]) / retarded
        reduction = 1.0 / (1.0 + compliance * per_turn)
        twist = compliance * torque - law.retardation / retarded * work.twist_past[i]
        twist += 2.0 * harder * work.twist[i] / retarded
        work.torque[i] = torque
        work.twist_increment[i] = (twist - work.twist[i]) * reduction if law.compliance > 0.0 else 0.0
        work.twist_gain[i] = compliance * per_turn * reduction
        work.residual[i] -= chain.tissue[i] * (torque - per_turn * work.twist_increment[i])
        work.diagonal[i] += chain.tissue[i] * per_turn * reduction


@njit(cache=True)
def _add_sheath_and_curvature(
    law: LawParameters, chain: CellChain, state: RigState, work: NewtonWorkspace
) -> None:
    if law.sheath == 0.0 and law.curvature == 0.0:
        return
    for i in range(work.angle.size):
        z, gain = preslide(law.limit, state.sheath[i], work.angle[i] - state.angle[i])
        sheath = chain.sheath[i] * law.sheath / law.limit
        curvature, tilt = chain.tissue[i] * law.curvature, work.angle[i] - law.phase
        work.residual[i] -= sheath * z + curvature * math.sin(tilt)
        work.diagonal[i] += sheath * gain + curvature * math.cos(tilt)


@njit(cache=True)
def entry_turn(chain: CellChain, state: RigState, work: NewtonWorkspace) -> float:
    """Turn of the shaft at the entry within the step, rad."""
    travel = 0.0
    for i in range(work.angle.size):
        if chain.passing[i] > 0.0:
            travel += chain.passing[i] * (work.angle[i] - state.angle[i])
    return travel


@njit(cache=True)
def _add_entry(law: LawParameters, chain: CellChain, state: RigState, work: NewtonWorkspace) -> None:
    if law.entry == 0.0:
        return
    z, gain = preslide(law.limit, state.lumped[ENTRY], entry_turn(chain, state, work))
    for i in range(work.angle.size):
        if chain.entry[i] > 0.0:
            level = law.entry * chain.entry[i] / law.limit
            work.residual[i] -= level * z
            work.diagonal[i] += level * gain * chain.passing[i]
            if i > 0:
                work.lower[i] += level * gain * chain.passing[i - 1]
            if i + 1 < work.angle.size:
                work.upper[i] += level * gain * chain.passing[i + 1]


@njit(cache=True)
def _add_tip(law: LawParameters, state: RigState, inputs: StepInput, work: NewtonWorkspace) -> None:
    last = work.angle.size - 1
    level = (law.load * abs(inputs.tip_torque) + law.tip_dry) / law.limit
    z, gain = preslide(law.limit, state.lumped[TIP], work.angle[last] - state.angle[last])
    rate = inputs.lead * work.angle[last] + work.angle_past[last]
    work.residual[last] -= inputs.tip_torque + law.tip_drag * rate + level * z
    work.diagonal[last] += law.tip_drag * inputs.lead + level * gain
    tilt = 2.0 * (work.angle[last] - law.fibre_phase)
    work.residual[last] -= law.fibre * math.sin(tilt)
    work.diagonal[last] += 2.0 * law.fibre * math.cos(tilt)
