"""The numeric fields of a MuJoCo model, from which the callback reads what MuJoCo has no place for.

They are, in order: the header, the node positions, the law table and, of a needle whose bodies do not
hinge on one another, the springs between them (sim.kernel.memory_map). All are in SI units.
"""

import numpy as np
from numpy.typing import NDArray

from models import units
from sim.discretisation import Mesh, SlipRate
from sim.kernel import memory_map
from sim.needles.setup import Setup

Array = NDArray[np.float64]

_NEVER_RAD = 1e6  # a stop that no slip comes to


def _advection_coefficient(setup: Setup) -> float:
    """c in: slip rate = omega + c v dtheta/dx."""
    share = setup.slip_share
    if share is None:
        share = 1.0 if setup.discretisation.slip is SlipRate.MATERIAL_DERIVATIVE else 0.0
    return share - 1.0 if setup.mesh is Mesh.LAGRANGIAN else share


def header(setup: Setup, *, rows: int) -> Array:
    """The `needle` numeric of `sim.kernel.memory_map`, SI."""
    head = np.zeros(memory_map.HEADER)
    head[memory_map.H_MAGIC] = memory_map.MAGIC
    head[memory_map.H_ELEMENTS] = setup.nodes_mm.size - 1
    head[memory_map.H_ROWS] = rows
    head[memory_map.H_ORDER] = setup.discretisation.order
    head[memory_map.H_BACKLASH] = 0.5 * setup.drive.backlash_deg * units.DEG
    head[memory_map.H_UNWINDING] = setup.drive.unwinding_ratio
    if setup.drive.loosens is not None:
        head[memory_map.H_LOOSE] = 0.5 * setup.drive.loosens.play_deg * units.DEG
        head[memory_map.H_LOOSE_FROM] = setup.drive.loosens.from_s
        head[memory_map.H_LOOSE_OVER] = setup.drive.loosens.over_s
    head[memory_map.H_GRIP] = (setup.drive.grip_torque_n_mm or 0.0) * units.N_MM
    stop_deg = setup.drive.grip_play_deg
    head[memory_map.H_STOP] = _NEVER_RAD if stop_deg is None else 0.5 * stop_deg * units.DEG
    head[memory_map.H_SPRING] = setup.drive.grip_stiffness_n_mm_per_rad * units.N_MM
    head[memory_map.H_PRESLIDING] = setup.discretisation.presliding_deg * units.DEG
    head[memory_map.H_RADIUS] = setup.needle.radius_mm * units.MM
    head[memory_map.H_ADVECTION] = _advection_coefficient(setup)
    head[memory_map.H_STRETCHING] = setup.stretching
    head[memory_map.H_FED] = setup.mesh is Mesh.FED
    head[memory_map.H_FREE_REF] = setup.free_mm * units.MM
    if setup.needle.stiffness_curve:
        head[memory_map.H_STIFFNESS_TORQUE] = setup.needle.stiffness_torque_n_mm * units.N_MM
        curve = slice(memory_map.H_STIFFNESS_0, memory_map.H_YIELD)
        head[curve] = np.log(setup.needle.stiffness_curve)
    head[memory_map.H_YIELD] = (setup.needle.yield_torque_n_mm or 0.0) * units.N_MM
    head[memory_map.H_YIELD_SLOPE] = setup.needle.yield_stiffness_ratio
    head[memory_map.H_CREEP] = setup.needle.creep_ratio
    head[memory_map.H_CREEP_TIME] = setup.needle.creep_time_s
    head[memory_map.H_SHAFT_DAMPING] = setup.needle.damping_time_s
    head[memory_map.H_CHAIN] = setup.is_chain
    head[memory_map.H_JOINT] = 0.5 * setup.needle.joint_play_deg * units.DEG
    head[memory_map.H_JOINT_AT] = _joint_at(setup)
    return head


def _joint_at(setup: Setup) -> float:
    """The element that the joint is in; between the middles of two, the part that is in the second."""
    middles = _from_tip_mm(setup)
    return float(np.interp(-setup.needle.joint_from_tip_mm, -middles, np.arange(middles.size)))


def _from_tip_mm(setup: Setup) -> Array:
    """Middles of the elements, from the tip, at the start, (n,)."""
    nodes = setup.nodes_mm
    return np.asarray(nodes[-1] - 0.5 * (nodes[1:] + nodes[:-1]))


def springs_n_m_per_rad(setup: Setup) -> Array:
    """Torsional stiffness kappa / a of every element at the start, (n,), in series with a soft joint."""
    needle = setup.needle
    lengths_mm = np.diff(setup.nodes_mm) / needle.stiffness_factors(_from_tip_mm(setup))
    if needle.joint_length_mm > 0.0:
        lengths_mm += needle.joint_length_mm * _share_of_joint(setup)
    return np.asarray(needle.rigidity_n_mm2 * units.N_MM2 / (lengths_mm * units.MM))


def _share_of_joint(setup: Setup) -> Array:
    """The part of the joint that is in every element, (n,)."""
    each = np.arange(setup.nodes_mm.size - 1)
    return np.asarray(np.maximum(1.0 - np.abs(each - _joint_at(setup)), 0.0))


def numeric_fields(setup: Setup) -> dict[str, Array]:
    """The numeric fields of `sim.kernel.memory_map` by name, in their order."""
    fields = {
        "needle": header(setup, rows=len(setup.law)),
        "needle_mesh": setup.nodes_mm * units.MM,
        "needle_law": setup.law.ravel(),
    }
    if not setup.is_chain:
        fields["needle_springs"] = springs_n_m_per_rad(setup)
    return fields
