"""The run in compiled loops without MuJoCo: a plain theta method, and our own kernel.

The plain loop has the cells of `benchmarks.lumped_laws`. Its stage of length
g = theta h (theta = 1: backward Euler, 1/2: implicit midpoint) solves for rates w

    spring (differences of angle + g w) = d w + c    per mm, in every cell,

where d and c linearise the cell's tissue: Kelvin-Voigt elements condense exactly, and
dry friction is repeated until every cell slips or sticks as was assumed. Then all
moves by 1/theta of what it moved in the stage.
"""

import ctypes
from collections.abc import Callable

import mujoco
import numpy as np
from numba import njit
from numpy.typing import NDArray

from benchmarks.tissues import DAMPING, END_S, LENGTH_MM, RIGIDITY, TURN_RAD, TURN_S, Case
from sim.kernel import memory_map
from sim.kernel.native.callback import install
from sim.kernel.native.struct_offsets import read_struct_offsets

Array = NDArray[np.float64]
Answer = tuple[Array, Array]

BACKWARD_EULER, MIDPOINT = 1.0, 0.5
_PASSES = 50


@njit
def _linearised(law: Array, g: float, site: float, way: int) -> tuple[float, float]:
    """d and c of one cell; `site` is its phi or z, `way` -1, 0 or 1 as it slips."""
    damping, stiffness, time_constant, level, limit = law
    if stiffness > 0.0:
        resistance = stiffness * (time_constant + g)
        share = resistance / (resistance + damping)
        return damping * share, stiffness * site * (1.0 - share)
    if way != 0:
        return damping, level * way
    return damping + level * g / limit, level * site / limit


@njit
def _site_after(law: Array, g: float, site: float, rate: float, torque: float) -> float:
    """phi or z at the end of a stage."""
    _, stiffness, time_constant, _, limit = law
    if stiffness > 0.0:
        return site + g * (torque - stiffness * site) / (stiffness * (time_constant + g))
    return min(max(site + g * rate, -limit), limit)


@njit
def _solve(
    law: Array, g: float, spring: float, base: float, theta: Array, site: Array, ways: Array, rate: Array
) -> bool:
    """Rates of a stage for assumed slips; whether the slips came out as assumed."""
    n = theta.size
    sweep = np.empty(n)
    carried, before = 2.0 * (base - theta[0]), 0.0
    for i in range(n):  # Thomas' algorithm, downwards
        leaving = theta[i] - theta[i + 1] if i < n - 1 else 0.0
        d, c = _linearised(law, g, site[i], ways[i])
        own = (2.0 if i == 0 else 1.0) + (1.0 if i < n - 1 else 0.0)
        lower = g * spring if i > 0 else 0.0
        pivot = d + g * spring * own - lower * before
        last = rate[i - 1] if i > 0 else 0.0
        rate[i] = (spring * (carried - leaving) - c + lower * last) / pivot
        before = g * spring / pivot
        sweep[i] = before
        carried = leaving
    for i in range(n - 2, -1, -1):
        rate[i] += sweep[i] * rate[i + 1]
    as_assumed, limit = True, law[4]
    if law[3] == 0.0:
        return True
    for i in range(n):
        reached = site[i] + g * rate[i]
        way = (1 if reached > limit else 0) - (1 if reached < -limit else 0)
        as_assumed &= way == ways[i]
        ways[i] = way
    return as_assumed


@njit
def _theta_method(law: Array, spring: float, cells: int, h: float, implicit: float) -> Array:
    """Tip after every step, rad."""
    theta, site, rate = np.zeros(cells), np.zeros(cells), np.zeros(cells)
    ways = np.zeros(cells, np.int64)
    g = implicit * h
    tips = np.zeros(int(np.ceil(END_S / h - 1e-9)) + 1)
    for k in range(1, tips.size):
        base = TURN_RAD * min(((k - 1) * h + g) / TURN_S, 1.0)
        for _ in range(_PASSES):
            if _solve(law, g, spring, base, theta, site, ways, rate):
                break
        for i in range(cells):
            d, c = _linearised(law, g, site[i], ways[i])
            after = _site_after(law, g, site[i], rate[i], d * rate[i] + c)
            site[i] += (after - site[i]) / implicit
            theta[i] += h * rate[i]
        tips[k] = (9.0 * theta[-1] - theta[-2]) / 8.0
    return tips


def by_theta_method(case: Case, cells: int, step_s: float, implicit: float) -> Answer:
    """Backward Euler or implicit midpoint in one compiled loop."""
    law = np.array([DAMPING, case.stiffness, case.time_constant_s, case.level, case.yield_rad])
    tips = _theta_method(law, RIGIDITY / (LENGTH_MM / cells) ** 2, cells, step_s, implicit)
    return step_s * np.arange(tips.size), np.degrees(tips)


def kernel_loop() -> Callable[[mujoco.MjModel, mujoco.MjData, Array], Array]:
    """A loop of the tissue callback by itself, for a model of siblings.

    It takes the model, its data at the start, and the inputs at every step, SI, and
    returns the tip at every step, rad.
    """
    passive, time_at = install()[0].ctypes, read_struct_offsets().data["time"]

    @njit
    def loop(
        model: int,
        data: int,
        at: int,
        h: float,
        clock: Array,
        qpos: Array,
        ctrl: Array,
        user: Array,
        force: Array,
        inputs: Array,
    ) -> Array:
        nodes = qpos.size - 1
        tips = np.zeros(inputs.shape[0])
        qpos[:], user[:], clock[0] = 0.0, 0.0, 0.0
        for k in range(1, inputs.shape[0]):
            ctrl[:], force[:] = inputs[k], 0.0
            passive(model, data)
            qpos[1:] = user[at : at + nodes]
            clock[0] += h
            tips[k] = qpos[nodes]
        return tips

    def run(model: mujoco.MjModel, data: mujoco.MjData, inputs: Array) -> Array:
        clock = np.ctypeslib.as_array((ctypes.c_double * 1).from_address(data._address + time_at))
        fields = (clock, data.qpos, data.ctrl, data.userdata, data.qfrc_passive)
        head = model.numeric("needle").data
        size = memory_map.block(int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS]))
        at = memory_map.CLOCK + size + memory_map.B_ANGLES
        h = model.opt.timestep
        tips: Array = loop(model._address, data._address, at, h, *fields, inputs)
        return tips

    return run
