"""Running needles in MuJoCo: one, or many side by side."""

from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import DriveKind
from models.errors import InvalidValue, NeedleError
from sim.discretisation import Arrangement
from sim.kernel import memory_map
from sim.kernel.callback import install
from sim.needles import callback_loop
from sim.needles.kept import batch_of, models_in_turn, models_of
from sim.schedule import Schedule
from sim.spec import Setup

Array = NDArray[np.float64]

_LANDING_TOLERANCE_RAD = 1e-8
_SAME_TIME = 1e-6  # of a step


class SimulationFailed(NeedleError):
    """A run stopped early, or its results cannot be trusted."""


@dataclass(frozen=True, kw_only=True)
class Run:
    """The result of a simulation: N samples, n + 1 nodes.

    Attributes:
      inputs: the inputs at the ends of the steps.
      outputs: (N, memory_map.OUTPUTS), SI, as the model's sensors return them.
      angles_rad: (N, n + 1), or None if they were not kept.
      tissue_rad: (N, rows, n, 2) twist of the tissue at its sites, or None.
      unconverged: number of stages whose iteration did not converge; 0 in a good run.
    """

    setup: Setup
    inputs: Schedule
    outputs: Array
    angles_rad: Array | None = None
    tissue_rad: Array | None = None

    @property
    def time_s(self) -> Array:
        """Ends of the steps, s, (N,); the first is the start."""
        return self.inputs.time_s

    @property
    def tip_deg(self) -> Array:
        """Angle of the tip, deg, (N,)."""
        return self.outputs[:, memory_map.O_TIP_ANGLE] / units.DEG

    @property
    def base_deg(self) -> Array:
        """Angle of the needle at the chuck, deg, (N,)."""
        return self.outputs[:, memory_map.O_BASE_ANGLE] / units.DEG

    @property
    def shaft_deg(self) -> Array:
        """Angle of the drive shaft, deg, (N,); of the needle's base if the drive gives torque."""
        driven_by_angle = self.setup.drive.kind is DriveKind.ANGLE
        return self.inputs.drive if driven_by_angle else self.base_deg

    @property
    def base_torque_n_mm(self) -> Array:
        """Torque of the drive on the needle, N mm, (N,)."""
        return self.outputs[:, memory_map.O_BASE_TORQUE] / units.N_MM

    def since(self, start_s: float) -> "Run":
        """The run from a time on; the same run if it begins there."""
        kept = self.time_s >= start_s - _SAME_TIME * self.setup.discretisation.step_s
        if kept.all():
            return self
        return replace(
            self,
            inputs=self.inputs.rows(kept),
            outputs=self.outputs[kept],
            angles_rad=None if self.angles_rad is None else self.angles_rad[kept],
            tissue_rad=None if self.tissue_rad is None else self.tissue_rad[kept],
        )

    @property
    def unconverged(self) -> int:
        """Number of stages whose iteration did not converge."""
        return int(self.outputs[-1, memory_map.O_FAILED])


def prepare_processes() -> None:
    """Compile and install the tissue callback, so that processes forked afterwards inherit it.

    The first call on a machine compiles for up to a minute; the machine code is cached on disk.
    """
    install()
    callback_loop.prepare()


@dataclass(frozen=True, kw_only=True)
class PassiveTorques:
    """What the callback added to `qfrc_passive` in the last step, N m, (n + 1,) hinges each.

    Attributes:
      tissue: torque of the tissue on the shaft; the mean over the step for second order.
      other: torques that the model's joints cannot represent: play of the drive, an element whose
        length changes, springs of siblings; 0 without them.
      correction: makes MuJoCo's first-order step one of second order; 0 for a step of order 1.
    """

    tissue: Array
    other: Array
    correction: Array


def passive_torques(model: mujoco.MjModel, data: mujoco.MjData) -> PassiveTorques:
    """The separate torques of the last `mj_step` or `mj_forward`."""
    head = model.numeric("needle").data
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    at = memory_map.CLOCK + 2 * memory_map.block(n, rows)
    torques = data.userdata[at : at + memory_map.torques(n)].reshape(memory_map.TORQUES, n + 1).copy()
    return PassiveTorques(
        tissue=torques[memory_map.T_TISSUE],
        other=torques[memory_map.T_OTHER],
        correction=torques[memory_map.T_CORRECTION],
    )


def controls(inputs: Schedule, setup: Setup) -> Array:
    """`ctrl` at every sample, SI, (N, inputs)."""
    ctrl = np.zeros((inputs.time_s.size, memory_map.INPUTS))
    scale = units.DEG if setup.drive.kind is DriveKind.ANGLE else units.N_MM
    ctrl[:, memory_map.U_DRIVE] = inputs.drive * scale
    ctrl[:, memory_map.U_CARRIAGE] = (setup.free_mm - inputs.free_mm) * units.MM
    ctrl[:, memory_map.U_INSERTED] = inputs.inserted_mm * units.MM
    ctrl[:, memory_map.U_SPEED] = inputs.speed_mm_s * units.MM
    ctrl[:, memory_map.U_TIP] = inputs.tip_torque_n_mm * units.N_MM
    ctrl[:, memory_map.U_TISSUE] = inputs.tissue_factor - 1.0
    return ctrl


def _controls_of_each(inputs: Sequence[Schedule], setups: Sequence[Setup]) -> list[Array]:
    """`ctrl` of every set-up; those with the same inputs, drive and free length share it."""
    made: dict[tuple[Schedule, DriveKind, float], Array] = {}
    each = []
    for own, setup in zip(inputs, setups, strict=True):
        key = own, setup.drive.kind, setup.free_mm
        if key not in made:
            made[key] = controls(own, setup)
        each.append(made[key])
    return each


def initial_data(model: mujoco.MjModel, setup: Setup, ctrl: Array) -> mujoco.MjData:
    """Data of an untwisted needle at rest, at the first of the inputs.

    Args:
      ctrl: the inputs at the start, SI, (inputs,).
    """
    data = mujoco.MjData(model)
    data.qpos[:] = _start(setup, ctrl)
    data.ctrl[:] = ctrl
    mujoco.mj_forward(model, data)
    return data


def _start(setup: Setup, ctrl: Array) -> Array:
    """Joints of an untwisted needle, the carriage's first: m, then rad, (joints,)."""
    qpos = np.zeros(memory_map.FIRST_JOINT + setup.nodes_mm.size)
    qpos[0] = ctrl[memory_map.U_CARRIAGE]
    if setup.drive.kind is DriveKind.ANGLE:
        qpos[1 : 2 if _is_chain(setup) else None] = ctrl[memory_map.U_DRIVE]
    return qpos


def _is_chain(setup: Setup) -> bool:
    return setup.discretisation.arrangement is Arrangement.CHAIN


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
    stepped = _at_steps(inputs, len(setups), step_s)
    ctrl = _controls_of_each(stepped, setups)
    starts = [_start(setup, own[0]) for setup, own in zip(setups, ctrl, strict=True)]
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
        _run(setup, stepped[i], starts[i], ctrl[i][0], outputs[i], {k: v[i] for k, v in shape.items()})
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


def _at_steps(inputs: Schedule | Sequence[Schedule], count: int, step_s: float) -> list[Schedule]:
    """The inputs of every set-up at the ends of steps; shared ones stay shared."""
    each = [inputs] * count if isinstance(inputs, Schedule) else list(inputs)
    if len(each) != count:
        raise InvalidValue("inputs", len(each), f"one schedule, or one for each of {count} set-ups")
    stepped = [own.at_steps(step_s) for own in each]
    spans = {(float(own.time_s[0]), own.time_s.size) for own in stepped}
    if len(spans) > 1:
        raise InvalidValue(
            "inputs", sorted(spans), "schedules with the same start and the same number of steps"
        )
    return stepped


def _run(
    setup: Setup,
    inputs: Schedule,
    start: Array,
    ctrl: Array,
    outputs: Array,
    shape: dict[str, Array],
) -> Run:
    """The run from the joints `start` with the inputs `ctrl`, given the outputs after the start."""
    outputs[0] = _at_rest(setup, start, ctrl)
    if setup.drive.kind is DriveKind.ANGLE and setup.discretisation.order > 1:
        _centre_inertia(outputs)
    refuse_untrustworthy(outputs, inputs.time_s, setup.discretisation.step_s)
    if not shape:
        return Run(setup=setup, inputs=inputs, outputs=outputs)
    angles = np.vstack([start[1:], shape["qpos"][:, 1:]])
    if _is_chain(setup):
        angles = np.cumsum(angles, axis=1)
    return Run(
        setup=setup,
        inputs=inputs,
        outputs=outputs,
        angles_rad=angles,
        tissue_rad=_tissue(setup, shape["userdata"]),
    )


def refuse_untrustworthy(outputs: Array, time_s: Array, step_s: float) -> None:
    """Checks that every run has to pass, with and without MuJoCo's steps.

    Raises:
      SimulationFailed: outputs are not finite, or MuJoCo's step did not end where the callback's did.
    """
    if not np.isfinite(outputs).all():
        bad = time_s[np.flatnonzero(~np.isfinite(outputs).all(axis=1))[0]]
        raise SimulationFailed(
            f"expected finite outputs, found NaN or infinity at {bad:.3f} s; take a smaller step "
            f"than {step_s:.3g} s, or check the tissue's parameters"
        )
    landing = float(outputs[-1, memory_map.O_LANDING])
    if landing > _LANDING_TOLERANCE_RAD:
        raise SimulationFailed(
            f"expected MuJoCo's step to end within {_LANDING_TOLERANCE_RAD:.0e} rad of the angles "
            f"that the callback computed, found {landing:.1e} rad; remove any other passive "
            "callback, and change nothing in the model but its stiffness, inertia, servos and step"
        )


def _centre_inertia(outputs: Array) -> None:
    """Assign the inertia's share of the base torque to its sample, in place.

    A step computes it for its start, so the share of a sample is known only in the step after it.
    """
    inertia = outputs[:, memory_map.O_INERTIA]
    outputs[:-1, memory_map.O_BASE_TORQUE] += inertia[1:] - inertia[:-1]


def _at_rest(setup: Setup, start: Array, ctrl: Array) -> Array:
    """The outputs at the start, before anything has moved."""
    row = np.zeros(memory_map.OUTPUTS)
    row[[memory_map.O_BASE_ANGLE, memory_map.O_TIP_ANGLE]] = start[1]
    row[memory_map.O_TIP_TORQUE] = ctrl[memory_map.U_TIP]
    if setup.drive.kind is DriveKind.TORQUE:
        row[memory_map.O_BASE_TORQUE] = ctrl[memory_map.U_DRIVE]
    return row


def _tissue(setup: Setup, userdata: Array) -> Array:
    n, rows = setup.nodes_mm.size - 1, len(setup.law)
    size = memory_map.block(n, rows)
    at = memory_map.CLOCK + size + memory_map.sites_at(n)
    sites = userdata[:, at : at + memory_map.SITE * 2 * n * rows].reshape(
        -1, rows, n, 2, memory_map.SITE
    )
    twist: Array = sites[..., memory_map.PHI]
    return np.concatenate([np.zeros((1, *twist.shape[1:])), twist])
