"""A needle in MuJoCo under feedback control, which acts on the base joint only.

The loop runs at the step of the simulation: the controller receives the readings of base angle
and base torque (and of the tip, if there is a sensor), and returns the base angle that the drive
should reach by the next step. The hardware between controller and needle is that of `sim.loop`;
it is ideal by default.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import DriveKind
from sim.discretisation import Mesh
from sim.kernel import memory_map
from sim.loop.hardware import LoopHardware
from sim.loop.measurement import CHANNELS, Measurement, MeasurementNoise, SensorReadings
from sim.loop.servo_loop import ServoLoop
from sim.loop.shaft import CommandedShaft
from sim.needles.inputs import controls, initial_data
from sim.needles.kept import compile_model
from sim.needles.run import Run, refuse_untrustworthy
from sim.needles.setup import Setup
from sim.schedule import Schedule

__all__ = ["ClosedLoopRun", "FeedbackController", "Measurement", "MeasurementNoise", "run_closed_loop"]

Array = NDArray[np.float64]

_PROGRESS_EVERY = 1000  # steps: a tenth of a second


class FeedbackController(Protocol):
    """Computes the base angle, deg, from a measurement and a reference."""

    def __call__(self, measurement: Measurement, reference_deg: float) -> float:
        """The base angle for the next step, deg; `reference_deg` is the wanted tip angle."""

    @property
    def advance_mm(self) -> float:
        """Axial motion in addition to the scheduled one, mm; negative: retraction."""


@dataclass(frozen=True, kw_only=True)
class ClosedLoopRun:
    """A run under control.

    Attributes:
      run: as from `sim.simulation.simulate`; `run.inputs.drive` is the actual angle of the drive
        shaft, deg, or the torque of the motor, N mm.
      reference_deg: reference of the tip, (N,).
      command_deg: base angle that the controller commanded at each sample, (N,).
      measured: readings, by the names of `sim.loop.measurement.CHANNELS`, (N,) each.
      log: signals of the controller by name, (N,) each.
    """

    run: Run
    reference_deg: Array
    command_deg: Array
    measured: dict[str, Array]
    log: dict[str, Array] = field(default_factory=dict)

    @property
    def shaft_deg(self) -> Array:
        """Angle of the drive shaft, deg, (N,)."""
        return self.run.shaft_deg


def run_closed_loop(
    setup: Setup,
    inputs: Schedule,
    controller: FeedbackController,
    *,
    noise: MeasurementNoise | None = None,
    hardware: LoopHardware | None = None,
    log: Callable[[], dict[str, float]] | None = None,
    keep_shape: bool = False,
    progress: Callable[[float], None] = lambda share: None,
) -> ClosedLoopRun:
    """Run a needle whose base is turned by a controller.

    Args:
      inputs: scheduled lengths and speed; `drive` is the reference of the tip, deg.
      noise: noise of the sensors; None: none.
      hardware: drive and sensors; None: ideal.
      log: called after each command; the signals that it returns are recorded.
      keep_shape: record the angles of all nodes.
      progress: called from time to time with the share that is done.
    """
    loop, logged = _Loop(setup, inputs, noise or MeasurementNoise(), hardware or LoopHardware()), []
    for i in range(loop.samples):
        if i % _PROGRESS_EVERY == 0:
            progress(i / loop.samples)
        if i:
            loop.step(i)
        base_deg = controller(loop.measurement(i), float(loop.scheduled.drive[i]))
        if log is not None:
            logged.append(log())
        loop.command(i, base_deg, controller.advance_mm)
    return ClosedLoopRun(
        run=loop.run(keep_shape=keep_shape),
        reference_deg=loop.scheduled.drive,
        command_deg=loop.command_deg,
        measured=dict(zip(CHANNELS, loop.measured.T, strict=True)),
        log={name: np.array([row[name] for row in logged]) for name in (logged[0] if logged else {})},
    )


class _Loop:
    """The simulated rig during a run: row i of each array belongs to the end of step i."""

    def __init__(
        self, setup: Setup, inputs: Schedule, noise: MeasurementNoise, hardware: LoopHardware
    ) -> None:
        step_s = setup.discretisation.step_s
        self.setup, self.scheduled = setup, inputs.at_steps(step_s)
        self.samples = self.scheduled.time_s.size
        self.command_deg, self.measured = np.zeros(self.samples), np.zeros((self.samples, 3))
        self._model = compile_model(setup)
        self._ctrl = controls(self.scheduled, setup)
        self._ctrl[:, memory_map.U_DRIVE] = 0.0
        self._data = initial_data(self._model, setup, self._ctrl[0])
        self._chain = self._model.numeric("needle").data[memory_map.H_CHAIN] != 0
        self._sensors = SensorReadings(hardware.sensors, noise, samples=self.samples, step_s=step_s)
        self._driven_by_angle = setup.drive.kind is DriveKind.ANGLE
        self._drive: CommandedShaft | ServoLoop = (
            CommandedShaft(hardware, step_s=step_s)
            if self._driven_by_angle
            else ServoLoop(hardware, setup.drive, step_s=step_s)
        )
        self._outputs = np.zeros((self.samples, memory_map.OUTPUTS))
        self._angles = np.zeros((self.samples, self._model.nq - 1))
        self._acting = np.zeros(self.samples)
        self._first_mm, self._stretching = float(np.diff(setup.nodes_mm[:2])[0]), setup.stretching
        self._bias_n_mm = hardware.sensors.torque_bias_n_mm
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
        """Readings of the sensors at sample i."""
        tip = self._outputs[i, memory_map.O_TIP_ANGLE] / units.DEG
        self.measured[i] = self._sensors.read(i, (self._shaft_deg(i), self._torque_n_mm(i), float(tip)))
        base_deg, torque_n_mm, tip_deg = self.measured[i].tolist()
        return Measurement(
            time_s=float(self.scheduled.time_s[i]),
            base_deg=base_deg,
            torque_n_mm=torque_n_mm,
            tip_deg=tip_deg,
            inserted_mm=float(self._inserted_mm[i]),
            free_mm=float(self._free_mm[i]),
        )

    def _shaft_deg(self, i: int) -> float:
        """Angle of the drive shaft, deg; with a torque drive, that of the needle's base on it."""
        if self._driven_by_angle:
            return float(self._acting[i])
        return float(self._outputs[i, memory_map.O_BASE_ANGLE]) / units.DEG

    def _torque_n_mm(self, i: int) -> float:
        """Torque on the needle, N mm; with a torque drive, that in its first element (part of the
        motor's torque accelerates the rotor)."""
        if self._driven_by_angle:
            return float(self._outputs[i, memory_map.O_BASE_TORQUE]) / units.N_MM
        grown = float(self._free_mm[i]) / self.setup.free_mm if self._stretching else 1.0
        twist_rad = float(self._angles[i, 0] - self._angles[i, 1])
        return self.setup.needle.rigidity_n_mm2 * twist_rad / (self._first_mm * grown)

    def command(self, i: int, base_deg: float, advance_mm: float) -> None:
        """Pass the command of sample i to drive and carriage; they act in the next step."""
        self.command_deg[i] = base_deg
        if i + 1 == self.samples:
            return
        self._act(i, base_deg)
        self._advance(i + 1, advance_mm)

    def _act(self, i: int, command_deg: float) -> None:
        if isinstance(self._drive, CommandedShaft):
            acting, scale = self._drive.follow(command_deg), units.DEG
        else:
            shaft, taken = self._shaft_deg(i), self._torque_n_mm(i)
            acting = self._drive.motor_torque_n_mm(command_deg, shaft, taken + self._bias_n_mm)
            scale = units.N_MM
        self._acting[i + 1] = acting
        self._ctrl[i + 1, memory_map.U_DRIVE] = acting * scale

    def _advance(self, i: int, advance_mm: float) -> None:
        self._advance_mm[i] = advance_mm
        speed_mm_s = (advance_mm - self._advance_mm[i - 1]) / self.setup.discretisation.step_s
        self._ctrl[i, memory_map.U_CARRIAGE] += advance_mm * units.MM
        self._ctrl[i, memory_map.U_SPEED] += speed_mm_s * units.MM
        self._free_mm[i] -= advance_mm
        if self.setup.mesh is Mesh.LAGRANGIAN:
            self._inserted_mm[i] = max(self._inserted_mm[i] + advance_mm, 0.0)
            self._ctrl[i, memory_map.U_INSERTED] = self._inserted_mm[i] * units.MM

    def run(self, *, keep_shape: bool) -> Run:
        """The run as recorded.

        Raises:
          SimulationFailed: see `sim.needles.run.refuse_untrustworthy`.
        """
        refuse_untrustworthy(self._outputs, self.scheduled.time_s, self.setup)
        lengths = {"free_mm": self._free_mm, "inserted_mm": self._inserted_mm}
        inputs = replace(self.scheduled, **lengths, drive=self._acting)
        angles = self._angles if keep_shape else None
        return Run(setup=self.setup, inputs=inputs, outputs=self._outputs, angles_rad=angles)
