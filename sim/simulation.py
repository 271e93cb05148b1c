"""Running needles in MuJoCo: one, or many side by side."""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from models import units
from models.drive import DriveKind
from models.errors import InvalidValue, NeedleError
from sim.kernel import wire
from sim.kernel.callback import install
from sim.schedule import Schedule
from sim.spec import Setup, needle_spec, renumbered

Array = NDArray[np.float64]

_INTEGRATION = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_LANDING_TOLERANCE_RAD = 1e-8


class SimulationFailed(NeedleError):
    """A run did not reach its end with numbers that can be trusted."""


@dataclass(frozen=True, kw_only=True)
class Run:
    """What a simulated needle did; N samples, n + 1 nodes.

    Attributes:
      inputs: the inputs at the ends of the steps.
      outputs: (N, wire.OUTPUTS), SI, as the sensors show them.
      angles_rad: (N, n + 1) or None where they were not kept.
      tissue_rad: (N, rows, n, 2) twist of the tissue at its sites, or None.
      unconverged: stages whose iteration did not converge; 0 in a good run.
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
        return self.outputs[:, wire.O_TIP_ANGLE] / units.DEG

    @property
    def base_deg(self) -> Array:
        """Angle of the needle at the chuck, deg, (N,)."""
        return self.outputs[:, wire.O_BASE_ANGLE] / units.DEG

    @property
    def base_torque_n_mm(self) -> Array:
        """Torque that the drive puts in, N mm, (N,)."""
        return self.outputs[:, wire.O_BASE_TORQUE] / units.N_MM

    @property
    def unconverged(self) -> int:
        """Stages whose iteration did not converge."""
        return int(self.outputs[-1, wire.O_FAILED])


def compile_model(setup: Setup) -> mujoco.MjModel:
    """The compiled model, with the tissue callback installed."""
    install()
    return needle_spec(setup).compile()


_TEMPLATES: dict[tuple[object, ...], mujoco.MjModel] = {}
_MOST_TEMPLATES = 64


def _model(setup: Setup) -> mujoco.MjModel:
    """A model of its own; where the bodies are known already, a copy with other numbers."""
    key = setup.bodies
    if key is None:
        return compile_model(setup)
    if key not in _TEMPLATES:
        if len(_TEMPLATES) >= _MOST_TEMPLATES:
            _TEMPLATES.clear()
        _TEMPLATES[key] = compile_model(setup)
    return renumbered(_TEMPLATES[key], setup)


def controls(inputs: Schedule, setup: Setup) -> Array:
    """`ctrl` at every sample, SI, (N, inputs)."""
    ctrl = np.zeros((inputs.time_s.size, wire.INPUTS))
    scale = units.DEG if setup.drive.kind is DriveKind.ANGLE else units.N_MM
    ctrl[:, wire.U_DRIVE] = inputs.drive * scale
    ctrl[:, wire.U_CARRIAGE] = (setup.free_mm - inputs.free_mm) * units.MM
    ctrl[:, wire.U_INSERTED] = inputs.inserted_mm * units.MM
    ctrl[:, wire.U_SPEED] = inputs.speed_mm_s * units.MM
    ctrl[:, wire.U_TIP] = inputs.tip_torque_n_mm * units.N_MM
    return ctrl


def initial_data(model: mujoco.MjModel, setup: Setup, ctrl: Array) -> mujoco.MjData:
    """Untwisted and at rest, at the first of the inputs.

    Args:
      ctrl: the inputs at the start, SI, (inputs,).
    """
    data = mujoco.MjData(model)
    if setup.drive.kind is DriveKind.ANGLE:
        chain = model.numeric("needle").data[wire.H_CHAIN] != 0
        data.qpos[1 : 2 if chain else None] = ctrl[wire.U_DRIVE]
    data.qpos[0] = ctrl[wire.U_CARRIAGE]
    data.ctrl[:] = ctrl
    mujoco.mj_forward(model, data)
    return data


def simulate(
    setups: Sequence[Setup], inputs: Schedule, *, keep_shape: bool = False, threads: int = 1
) -> list[Run]:
    """Run needles of one layout side by side through the same inputs.

    Args:
      setups: differ in anything but number of nodes, rows and step.
      inputs: sampled at any times; resampled to the step.
      keep_shape: keep the angles of all nodes and the twist of the tissue.
      threads: of MuJoCo's batch; results do not depend on it.

    Raises:
      InvalidValue: the setups do not share a layout.
      SimulationFailed: MuJoCo stopped, or its step did not land where it should.
    """
    models = [_model(setup) for setup in setups]
    first = models[0]
    for setup, model in zip(setups, models, strict=True):
        if (model.nq, model.nuserdata) != (first.nq, first.nuserdata):
            raise InvalidValue("setups", setup, "the same number of elements and rows", "set rows")
    stepped = inputs.at_steps(setups[0].discretisation.step_s)
    ctrl = np.stack([controls(stepped, setup) for setup in setups])
    batch = Batch(first, len(setups), threads)
    batch.set_models(models)
    starts = []
    for i, (setup, model) in enumerate(zip(setups, models, strict=True)):
        data = initial_data(model, setup, ctrl[i, 0])
        starts.append(data)
        state = np.empty(mujoco.mj_stateSize(model, _INTEGRATION))
        mujoco.mj_getState(model, data, state, _INTEGRATION)
        batch.state[i] = state
    record = ["sensordata", "qpos", "userdata"] if keep_shape else ["sensordata"]
    raw = batch.rollout(ctrl.shape[1] - 1, ctrl[:, 1:], record=record)
    return [
        _run(setups[i], stepped, starts[i], {k: v[i] for k, v in raw.items()})
        for i in range(len(setups))
    ]


def _run(setup: Setup, inputs: Schedule, start: mujoco.MjData, raw: dict[str, Array]) -> Run:
    outputs = np.vstack([_at_rest(start, setup), raw["sensordata"]])
    if not np.isfinite(outputs).all():
        bad = inputs.time_s[np.flatnonzero(~np.isfinite(outputs).all(axis=1))[0]]
        raise SimulationFailed(
            f"the simulation lost its numbers at {bad:.3f} s; take a smaller step than "
            f"{setup.discretisation.step_s} s, or check the tissue's parameters"
        )
    landing = float(outputs[-1, wire.O_LANDING])
    if landing > _LANDING_TOLERANCE_RAD:
        raise SimulationFailed(
            f"MuJoCo's step missed the wanted angles by {landing:.1e} rad; "
            "is another passive callback installed, or the model changed?"
        )
    if "qpos" not in raw:
        return Run(setup=setup, inputs=inputs, outputs=outputs)
    angles = np.vstack([start.qpos[None, 1:], raw["qpos"][:, 1:]])
    if start.model.numeric("needle").data[wire.H_CHAIN] != 0:
        angles = np.cumsum(angles, axis=1)
    return Run(
        setup=setup,
        inputs=inputs,
        outputs=outputs,
        angles_rad=angles,
        tissue_rad=_tissue(start, raw["userdata"]),
    )


def _at_rest(start: mujoco.MjData, setup: Setup) -> Array:
    """The outputs before anything has moved."""
    row = np.zeros(wire.OUTPUTS)
    row[[wire.O_BASE_ANGLE, wire.O_TIP_ANGLE]] = start.qpos[1]
    row[wire.O_TIP_TORQUE] = start.ctrl[wire.U_TIP]
    if setup.drive.kind is DriveKind.TORQUE:
        row[wire.O_BASE_TORQUE] = start.ctrl[wire.U_DRIVE]
    return row


def _tissue(start: mujoco.MjData, userdata: Array) -> Array:
    head = start.model.numeric("needle").data
    n, rows = int(head[wire.H_ELEMENTS]), int(head[wire.H_ROWS])
    size = wire.block(n, rows)
    at = wire.CLOCK + size + wire.B_ANGLES + 2 * (n + 1)
    sites = userdata[:, at : at + wire.SITE * 2 * n * rows].reshape(-1, rows, n, 2, wire.SITE)
    twist: Array = sites[..., wire.PHI]
    return np.concatenate([np.zeros((1, *twist.shape[1:])), twist])
