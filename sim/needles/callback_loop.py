"""Steps of the tissue callback by itself, without MuJoCo: for the iterations of a fit.

The callback computes the end of a step, and MuJoCo's step arrives there: within 1e-8 rad, or the run
is refused; usually within 1e-13 rad. So the sensitivity to a parameter is the same with and without
MuJoCo, at a fraction of the cost. Reported results are MuJoCo's; intermediate ones (iterations of a
fit, differences between runs) may be the callback's.
"""

import ctypes
from collections.abc import Iterable, Sequence
from functools import cache
from typing import Any

import mujoco
import numpy as np
from llvmlite import ir  # type: ignore[import-untyped]
from numba import njit, types
from numba.extending import intrinsic
from numpy.typing import NDArray

from sim.kernel import memory_map
from sim.kernel.native.callback import install
from sim.kernel.native.struct_offsets import read_struct_offsets
from sim.needles.kept import data_of

Array = NDArray[np.float64]


@intrinsic
def _calling(typingctx: Any, function: Any, model: Any, data: Any) -> Any:
    """Call a C function (model, data) at an address."""

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        word = args[1].type
        kind = ir.FunctionType(ir.VoidType(), [word, word]).as_pointer()
        builder.call(builder.inttoptr(args[0], kind), args[1:])
        return context.get_dummy_value()

    return types.void(types.intp, types.intp, types.intp), codegen


_call: Any = _calling


@njit(cache=True, nogil=True)
def _loop(
    callback: int,
    model: int,
    data: int,
    chain: bool,
    step_s: float,
    clock: Array,
    qpos: Array,
    qvel: Array,
    ctrl: Array,
    passive: Array,
    outputs: Array,
    angles: Array,
    inputs: Array,
    shown: Array,
) -> None:
    """Step through `inputs`, (N, inputs); `shown` receives the outputs, (N, outputs).

    Numba's cache knows this function's source alone, so that no place of the memory map is in it.

    Args:
      outputs, angles: where the callback leaves them at the end of a step, (outputs,) and (n + 1,).
    """
    for k in range(inputs.shape[0]):
        ctrl[:], passive[:] = inputs[k], 0.0
        _call(callback, model, data)
        shown[k] = outputs
        before = 0.0
        for i, end in enumerate(angles):
            joint = end - before if chain else end
            before = end
            qvel[1 + i] = (joint - qpos[1 + i]) / step_s
            qpos[1 + i] = joint
        clock[0] += step_s


def prepare() -> None:
    """Compile the loop, or load it from the cache, without a step."""
    one, none, bare = np.zeros(1), np.zeros((0, memory_map.INPUTS)), np.zeros((0, memory_map.OUTPUTS))
    _loop(0, 0, 0, False, 1.0, one, one, one, one, one, one, one, none, bare)


def run_callback(
    models: Iterable[mujoco.MjModel],
    starts: Sequence[Array],
    ctrl: Sequence[Array],
    shown: Sequence[Array],
) -> None:
    """Step needles one after the other.

    Args:
      models: one for each needle, which may be the same one with other numbers.
      starts: joints at the start, (joints,) each.
      ctrl: at the start and at the ends of steps, SI, (N + 1, inputs) each.
      shown: receives the outputs at the end of every step, (N, outputs) each.
    """
    for model, start, inputs, outputs in zip(models, starts, ctrl, shown, strict=True):
        with data_of(model) as data:
            _run(model, data, start, inputs, outputs)


def _run(model: mujoco.MjModel, data: mujoco.MjData, start: Array, ctrl: Array, shown: Array) -> None:
    data.qpos[:], data.ctrl[:] = start, ctrl[0]
    passive, _ = install()
    passive.ctypes(model._address, data._address)  # the start, as `mj_forward` has it done
    head = model.numeric_data[: memory_map.HEADER]
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    end = data.userdata[memory_map.CLOCK + memory_map.block(n, rows) :]
    _loop(
        passive.address,
        model._address,
        data._address,
        head[memory_map.H_CHAIN] != 0,
        model.opt.timestep,
        np.ctypeslib.as_array((ctypes.c_double * 1).from_address(data._address + _time_at())),
        data.qpos,
        data.qvel,
        data.ctrl,
        data.qfrc_passive,
        end[: memory_map.OUTPUTS],
        end[memory_map.B_ANGLES : memory_map.B_ANGLES + n + 1],
        ctrl[1:],
        shown,
    )


@cache
def _time_at() -> int:
    return read_struct_offsets().data["time"]
