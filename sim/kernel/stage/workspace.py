"""The working memory of one step, and what is constant during it."""

import math
from typing import NamedTuple

import numpy as np

from sim.kernel import memory_map
from sim.kernel.compiled import Array, inlined
from sim.kernel.shaft import Shaft
from sim.kernel.stage.inputs import Inputs
from sim.kernel.view import view


class Workspace(NamedTuple):
    """Arrays of one step: (n + 1) per node, (rows, n, 2, ...) per contact site."""

    x: np.ndarray  # node positions, m
    inertia: np.ndarray  # of the nodes over the length of a stage, N m s / rad
    spring: np.ndarray  # of the elements, N m / rad: torque over twist
    nominal: np.ndarray  # the same where the stiffness does not depend on the torque
    theta: np.ndarray  # theta* of the stage, rad
    rest: np.ndarray  # omega* of the stage, rad/s
    omega: np.ndarray  # the unknown rates, rad/s
    damp_lower: np.ndarray  # viscous rows, assembled; then with inertia and torsion
    damp_diagonal: np.ndarray
    damp_upper: np.ndarray
    lower: np.ndarray  # the linearised stage equation, then its factors
    diagonal: np.ndarray
    upper: np.ndarray
    rhs: np.ndarray
    step: np.ndarray  # Newton's step, rad/s
    loads: np.ndarray  # (rows, n, 4): what sites load the nodes with, m
    point: np.ndarray  # (rows, 2): element of a point row, and place in it
    places: np.ndarray  # (2 n + 1): where covered sites are, m
    twist: np.ndarray  # of the tissue there, rad
    set_before: np.ndarray  # (n): twist that elements keep without a torque, rad, before the stage
    set: np.ndarray  # the same at its end
    start: np.ndarray  # (rows, n, 2, SITE): site states at the start of the stage
    end: np.ndarray  # the same at its end


class Frame(NamedTuple):
    """What does not change during a step."""

    g: float  # length of a stage, s
    axial: float  # axial speed over the radius, rad/s
    drift: float  # speed of the shaft against the mesh, m/s
    yield_angle: float  # presliding angle, rad
    servo: float  # stiffness of the drive, N m / rad; 0: it gives torque
    backlash: float  # half of the play, rad
    factor: float = 1.0  # of rows that vary in time
    grip: float = 0.0  # torque at which the needle slips in the chuck, N m; 0: never
    yield_torque: float = 0.0  # beyond which elements twist plastically, N m; 0: never
    yield_slope: float = 0.0  # stiffness beyond it over the elastic one
    creep: float = 0.0  # twist that a torque adds in time, over the elastic one; 0: none
    creep_time: float = 0.0  # s
    stop: float = math.inf  # angle by which the needle slips in the chuck at most, rad
    spring: float = 0.0  # that brings it back, N m / rad
    joint: float = 0.0  # half of the play of a joint in the shaft, rad; 0: there is none
    joint_at: float = 0.0  # element that it is in, and the part of it that is in the next one
    unwinding: float = 1.0  # stiffness of the drive where the needle is ahead of it, over the other way


@inlined
def frame_of(head: Array, shaft: Shaft, g: float, inputs: Inputs, end: float) -> Frame:
    """What does not change during a step that ends at a time, s, with stages of length `g`, s."""
    return Frame(
        g,
        inputs.speed / head[memory_map.H_RADIUS],
        head[memory_map.H_ADVECTION] * inputs.speed,
        head[memory_map.H_PRESLIDING],
        shaft.servo,
        head[memory_map.H_BACKLASH] + _opened(head, end),
        inputs.tissue,
        head[memory_map.H_GRIP] if shaft.servo > 0.0 else 0.0,
        head[memory_map.H_YIELD],
        head[memory_map.H_YIELD_SLOPE],
        head[memory_map.H_CREEP],
        head[memory_map.H_CREEP_TIME],
        head[memory_map.H_STOP],
        head[memory_map.H_SPRING],
        head[memory_map.H_JOINT],
        head[memory_map.H_JOINT_AT],
        head[memory_map.H_UNWINDING],
    )


@inlined
def _opened(head: Array, time: float) -> float:
    """Half of the play that has opened until then, rad."""
    loose = head[memory_map.H_LOOSE]
    if loose == 0.0:
        return 0.0
    share = (time - head[memory_map.H_LOOSE_FROM]) / head[memory_map.H_LOOSE_OVER]
    return loose * min(max(share, 0.0), 1.0)


@inlined
def divide(memory: Array, n: int, rows: int, end: Array) -> Workspace:
    """Working memory cut into its arrays; `end` is the caller's site states.

    The memory is the model's own (`userdata`), so that no step allocates.
    """
    m = n + 1
    loads = 15 * m
    point = loads + 4 * n * rows
    places = point + 2 * rows
    twist = places + 2 * n + 1
    kept = twist + 2 * n + 1
    start = kept + 2 * n
    return Workspace(
        view(memory, 0, (m,)),
        view(memory, m, (m,)),
        view(memory, 2 * m, (m,)),
        view(memory, 3 * m, (m,)),
        view(memory, 4 * m, (m,)),
        view(memory, 5 * m, (m,)),
        view(memory, 6 * m, (m,)),
        view(memory, 7 * m, (m,)),
        view(memory, 8 * m, (m,)),
        view(memory, 9 * m, (m,)),
        view(memory, 10 * m, (m,)),
        view(memory, 11 * m, (m,)),
        view(memory, 12 * m, (m,)),
        view(memory, 13 * m, (m,)),
        view(memory, 14 * m, (m,)),
        view(memory, loads, (rows, n, 4)),
        view(memory, point, (rows, 2)),
        view(memory, places, (2 * n + 1,)),
        view(memory, twist, (2 * n + 1,)),
        view(memory, kept, (n,)),
        view(memory, kept + n, (n,)),
        view(memory, start, (rows, n, 2, memory_map.SITE)),
        end,
    )
