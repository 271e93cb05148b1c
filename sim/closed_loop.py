"""A needle in MuJoCo under feedback control, which acts on the base joint only.

The loop runs at the step of the simulation: the controller receives the measured base angle and
base torque of the sample (and the tip angle, if it is given a sensor for it), with sensor noise
where wanted, and returns the base angle for the next step.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from models import units
from sim.discretisation import Mesh
from sim.kernel import memory_map
from sim.schedule import Schedule
from sim.simulation import Run, compile_model, controls, initial_data
from sim.spec import Setup

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """What the sensors of the rig show at one sample: s, deg, N mm, mm."""

    time_s: float
    base_deg: float
    torque_n_mm: float
    tip_deg: float
    inserted_mm: float
    free_mm: float


class FeedbackController(Protocol):
    """Anything that turns the base: from a measurement and a reference to a base angle, deg."""

    def __call__(self, measurement: Measurement, reference_deg: float) -> float:
        """The base angle for the next step, deg; `reference_deg` is for the tip."""

    @property
    def advance_mm(self) -> float:
        """Axial motion wanted in addition to the scheduled one, mm: a retraction is negative."""


@dataclass(frozen=True, kw_only=True)
class MeasurementNoise:
    """One standard deviation of each sensor's white noise, and the seed of a run."""

    base_deg: float = 0.0
    torque_n_mm: float = 0.0
    tip_deg: float = 0.0
    seed: int = 0


@dataclass(frozen=True, kw_only=True)
class ClosedLoopRun:
    """A run under control.

    Attributes:
      run: as of `sim.simulation.simulate`; its drive is the commanded base angle.
      reference_deg: of the tip, (N,).
      log: signals of the controller by name, (N,) each.
    """

    run: Run
    reference_deg: Array
    log: dict[str, Array] = field(default_factory=dict)


def run_closed_loop(
    setup: Setup,
    inputs: Schedule,
    controller: FeedbackController,
    *,
    noise: MeasurementNoise | None = None,
    log: Callable[[], dict[str, float]] | None = None,
    keep_shape: bool = False,
) -> ClosedLoopRun:
    """Run a needle whose base a controller turns.

    Args:
      inputs: lengths and speed as scheduled; its `drive` is the reference of the tip, deg.
      log: called after each command; the signals that it returns are kept.
      keep_shape: keep the angles of all nodes.
    """
    loop, logged = _Loop(setup, inputs, noise or MeasurementNoise()), []
    for i in range(loop.samples):
        if i:
            loop.step(i)
        base_deg = controller(loop.measurement(i), float(loop.scheduled.drive[i]))
        if log is not None:
            logged.append(log())
        if i + 1 < loop.samples:
            loop.command(i + 1, base_deg, controller.advance_mm)
    return ClosedLoopRun(
        run=loop.run(keep_shape=keep_shape),
        reference_deg=loop.scheduled.drive,
        log={name: np.array([row[name] for row in logged]) for name in (logged[0] if logged else {})},
    )


class _Loop:
    """The simulated rig of a run: row i of each array belongs to the end of step i."""

    def __init__(self, setup: Setup, inputs: Schedule, noise: MeasurementNoise) -> None:
        self.setup, self.scheduled = setup, inputs.at_steps(setup.discretisation.step_s)
        self.samples = self.scheduled.time_s.size
        self._model = compile_model(setup)
        self._ctrl = controls(self.scheduled, setup)
        self._ctrl[:, memory_map.U_DRIVE] = 0.0
        self._data = initial_data(self._model, setup, self._ctrl[0])
        self._chain = self._model.numeric("needle").data[memory_map.H_CHAIN] != 0
        spread = np.array([noise.base_deg, noise.torque_n_mm, noise.tip_deg])
        self._noise = np.random.default_rng(noise.seed).normal(size=(self.samples, 3)) * spread
        self._outputs = np.zeros((self.samples, memory_map.OUTPUTS))
        self._angles = np.zeros((self.samples, self._model.nq - 1))
        self._base_deg = np.zeros(self.samples)
        # A controller may retract beside the schedule: the lengths follow what it does.
        self._advance_mm = np.zeros(self.samples)
        self._free_mm = self.scheduled.free_mm.copy()
        self._inserted_mm = self.scheduled.inserted_mm.copy()

    def step(self, i: int) -> None:
        """Advance MuJoCo to sample i."""
        self._data.ctrl[:] = self._ctrl[i]
        mujoco.mj_step(self._model, self._data)
        self._outputs[i] = self._data.sensordata
        joints = self._data.qpos[1:]
        self._angles[i] = np.cumsum(joints) if self._chain else joints

    def measurement(self, i: int) -> Measurement:
        """The sensors at sample i; the base angle is that of the drive shaft, as commanded."""
        torque = self._outputs[i, memory_map.O_BASE_TORQUE] / units.N_MM
        tip = self._outputs[i, memory_map.O_TIP_ANGLE] / units.DEG
        return Measurement(
            time_s=float(self.scheduled.time_s[i]),
            base_deg=self._base_deg[i] + self._noise[i, 0],
            torque_n_mm=float(torque + self._noise[i, 1]),
            tip_deg=float(tip + self._noise[i, 2]),
            inserted_mm=float(self._inserted_mm[i]),
            free_mm=float(self._free_mm[i]),
        )

    def command(self, i: int, base_deg: float, advance_mm: float) -> None:
        """Set what the drive and the carriage do in step i."""
        self._base_deg[i], self._advance_mm[i] = base_deg, advance_mm
        speed_mm_s = (advance_mm - self._advance_mm[i - 1]) / self.setup.discretisation.step_s
        self._ctrl[i, memory_map.U_DRIVE] = base_deg * units.DEG
        self._ctrl[i, memory_map.U_CARRIAGE] += advance_mm * units.MM
        self._ctrl[i, memory_map.U_SPEED] += speed_mm_s * units.MM
        self._free_mm[i] -= advance_mm
        if self.setup.mesh is Mesh.LAGRANGIAN:
            self._inserted_mm[i] = max(self._inserted_mm[i] + advance_mm, 0.0)
            self._ctrl[i, memory_map.U_INSERTED] = self._inserted_mm[i] * units.MM

    def run(self, *, keep_shape: bool) -> Run:
        """Everything that happened."""
        lengths = {"free_mm": self._free_mm, "inserted_mm": self._inserted_mm}
        inputs = Schedule(**{**_columns(self.scheduled), **lengths, "drive": self._base_deg})
        angles = self._angles if keep_shape else None
        return Run(setup=self.setup, inputs=inputs, outputs=self._outputs, angles_rad=angles)


def _columns(schedule: Schedule) -> dict[str, Any]:
    return {name: getattr(schedule, name) for name in schedule.__dataclass_fields__}
