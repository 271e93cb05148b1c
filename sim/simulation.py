"""Running needles in MuJoCo: one, or many side by side."""

from collections.abc import Sequence
from contextlib import nullcontext

import mujoco
import numpy as np
from numpy.typing import NDArray

from models.errors import InvalidValue
from sim.kernel import memory_map
from sim.kernel.native.callback import install
from sim.needles import callback_loop
from sim.needles.inputs import at_steps, controls_of_each, start_joints
from sim.needles.kept import batch_of, models_in_turn, models_of
from sim.needles.run import Run, run_of
from sim.needles.setup import Setup
from sim.schedule import Schedule

Array = NDArray[np.float64]


def prepare_processes() -> None:
    """Compile and install the tissue callback, so that processes forked afterwards inherit it.

    The first call on a machine compiles for up to a minute; the machine code is cached on disk.
    """
    install()
    callback_loop.prepare()


def simulate(
    setups: Sequence[Setup],
    inputs: Schedule | Sequence[Schedule],
    *,
    models: Sequence[mujoco.MjModel] | None = None,
    keep_shape: bool = False,
    threads: int = 1,
    callback_alone: bool = False,
) -> list[Run]:
    """Run needles of one model size in a batch, with the same inputs or each with its own.

    Args:
      setups: may differ in anything but the step, and, with MuJoCo's steps, the number of nodes and of
        rows.
      inputs: sampled at any times; resampled to the step. One for all set-ups, or one for each, all
        with the same start and end.
      models: models of the set-ups whose numbers were changed after compilation: their stiffness,
        inertia, servos and time step are simulated. None: as compiled.
      keep_shape: keep the angles of all nodes and the twist of the tissue.
      threads: number of threads of MuJoCo's batch; results do not depend on it.
      callback_alone: without MuJoCo's steps, for the iterations of a fit
        (sim.needles.callback_loop); no shape is kept.

    Raises:
      InvalidValue: set-ups of MuJoCo's steps differ in elements or rows of the law table; or there are
        not as many inputs as set-ups, or their durations differ.
      SimulationFailed: MuJoCo stopped, or its step did not end where the callback's did.
    """
    install()
    step_s = models[0].opt.timestep if models else setups[0].discretisation.step_s
    stepped = at_steps(inputs, len(setups), step_s)
    ctrl = controls_of_each(stepped, setups)
    starts = [start_joints(setup, own[0]) for setup, own in zip(setups, ctrl, strict=True)]
    outputs = [np.empty((len(own), memory_map.OUTPUTS)) for own in ctrl]
    shape: dict[str, Array] = {}
    if callback_alone:
        own = models_in_turn(setups) if models is None else models
        callback_loop.run_callback(own, starts, ctrl, [shown[1:] for shown in outputs])
    else:
        with models_of(setups) if models is None else nullcontext(models) as own:
            shape = _rollout(own, starts, ctrl, keep_shape=keep_shape, threads=threads)
        for shown, recorded in zip(outputs, shape.pop("sensordata"), strict=True):
            shown[1:] = recorded
    return [
        run_of(setup, stepped[i], starts[i], ctrl[i][0], outputs[i], {k: v[i] for k, v in shape.items()})
        for i, setup in enumerate(setups)
    ]


def _refuse_other_sizes(models: Sequence[mujoco.MjModel]) -> None:
    """Refuse models of different sizes: one batch cannot run them."""
    first = models[0]
    for model in models:
        if (model.nq, model.nuserdata) != (first.nq, first.nuserdata):
            raise InvalidValue(
                "setups",
                (model.nq, model.nuserdata),
                f"the same number of elements and rows in every set-up, {first.nq, first.nuserdata}",
                "set `rows` to the largest number of rows",
            )


def _rollout(
    models: Sequence[mujoco.MjModel],
    starts: Sequence[Array],
    ctrl: Sequence[Array],
    *,
    keep_shape: bool,
    threads: int,
) -> dict[str, Array]:
    """Step models of one size; returns MuJoCo's records at the ends of steps, (needles, N, ...) each.

    Args:
      starts: joints at the start, (joints,) each.
      ctrl: at the start and at the ends of steps, SI, (N + 1, inputs) each.
    """
    _refuse_other_sizes(models)
    record = ["sensordata", "qpos", "userdata"] if keep_shape else ["sensordata"]
    inputs = np.stack(ctrl)
    with batch_of(models, threads) as batch:
        batch.state[:] = 0.0
        batch.qpos, batch.ctrl = np.stack(starts), inputs[:, 0]
        batch.forward()
        return dict(batch.rollout(inputs.shape[1] - 1, inputs[:, 1:], record=record))
