"""A controller on the MuJoCo needle, acting on the base joint only.

The loop runs at the step of the simulation: the controller sees base angle and base
torque of the sample (and the tip, if it is given a sensor for it), with noise where
wanted, and gives the base angle for the next step.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from models import units
from sim.discretisation import Mesh
from sim.kernel import wire
from sim.schedule import Schedule
from sim.simulation import Run, compile_model, controls, initial_data
from sim.spec import Setup

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Reading:
    """What the rig's sensors say at a sample."""

    time_s: float
    base_deg: float
    torque_n_mm: float
    tip_deg: float
    inserted_mm: float
    free_mm: float


class Pilot(Protocol):
    """What drives the base: from a reading and a wish to a base angle, deg."""

    def __call__(self, reading: Reading, wanted_deg: float) -> float:
        """The base angle for the next step."""

    @property
    def advance_mm(self) -> float:
        """Axial motion wanted beside the scheduled one, mm: a retraction is negative."""


@dataclass(frozen=True, kw_only=True)
class SensorNoise:
    """One standard deviation of each sensor, and the seed of a run."""

    base_deg: float = 0.0
    torque_n_mm: float = 0.0
    tip_deg: float = 0.0
    seed: int = 0


@dataclass(frozen=True, kw_only=True)
class Flight:
    """A run under control.

    Attributes:
      run: as of `sim.simulation.simulate`; its drive is what was commanded.
      wanted_deg: (N,).
      log: whatever the pilot wanted kept, by name, (N,) each.
    """

    run: Run
    wanted_deg: Array
    log: dict[str, Array] = field(default_factory=dict)


def fly(
    setup: Setup,
    inputs: Schedule,
    pilot: Pilot,
    *,
    noise: SensorNoise | None = None,
    keep: Callable[[], dict[str, float]] | None = None,
    keep_shape: bool = False,
) -> Flight:
    """Run a needle whose base a pilot turns.

    Args:
      inputs: lengths and speed as scheduled; its `drive` is the wanted tip angle, deg.
      keep: called after each command; what it returns is logged.
      keep_shape: keep the angles of all nodes.
    """
    model = compile_model(setup)
    step = setup.discretisation.step_s
    wished = inputs.at_steps(step)
    ctrl = controls(wished, setup)
    ctrl[:, wire.U_DRIVE] = 0.0
    data = initial_data(model, setup, ctrl[0])
    chain = model.numeric("needle").data[wire.H_CHAIN] != 0
    noise = noise or SensorNoise()
    spread = np.array([noise.base_deg, noise.torque_n_mm, noise.tip_deg])
    errors = np.random.default_rng(noise.seed).normal(size=(wished.time_s.size, 3)) * spread
    outputs = np.zeros((wished.time_s.size, wire.OUTPUTS))
    angles = np.zeros((wished.time_s.size, model.nq - 1))
    drive = np.zeros(wished.time_s.size)
    kept: list[dict[str, float]] = []
    # A pilot may retract beside the schedule: what is measured and recorded moves with it.
    moved = np.zeros(wished.time_s.size)
    free, inserted = wished.free_mm.copy(), wished.inserted_mm.copy()
    for i in range(wished.time_s.size):
        if i:
            data.ctrl[:] = ctrl[i]
            mujoco.mj_step(model, data)
            outputs[i] = data.sensordata
            angles[i] = np.cumsum(data.qpos[1:]) if chain else data.qpos[1:]
        # The angle at the drive shaft is what was commanded; the rest is measured.
        reading = Reading(
            time_s=float(wished.time_s[i]),
            base_deg=drive[i] + errors[i, 0],
            torque_n_mm=float(outputs[i, wire.O_BASE_TORQUE] / units.N_MM + errors[i, 1]),
            tip_deg=float(outputs[i, wire.O_TIP_ANGLE] / units.DEG + errors[i, 2]),
            inserted_mm=float(inserted[i]),
            free_mm=float(free[i]),
        )
        wanted = pilot(reading, float(wished.drive[i]))
        if keep is not None:
            kept.append(keep())
        if i + 1 < drive.size:
            drive[i + 1] = wanted
            ctrl[i + 1, wire.U_DRIVE] = wanted * units.DEG
            moved[i + 1] = pilot.advance_mm
            speed_mm_s = (moved[i + 1] - moved[i]) / step
            ctrl[i + 1, wire.U_CARRIAGE] += moved[i + 1] * units.MM
            ctrl[i + 1, wire.U_SPEED] += speed_mm_s * units.MM
            free[i + 1] -= moved[i + 1]
            if setup.mesh is Mesh.NEEDLE:
                inserted[i + 1] = max(inserted[i + 1] + moved[i + 1], 0.0)
                ctrl[i + 1, wire.U_INSERTED] = inserted[i + 1] * units.MM
    lengths = {"free_mm": free, "inserted_mm": inserted}
    flown = Schedule(**{**_columns(wished), **lengths, "drive": drive})
    log = {name: np.array([row[name] for row in kept]) for name in (kept[0] if kept else {})}
    run = Run(setup=setup, inputs=flown, outputs=outputs, angles_rad=angles if keep_shape else None)
    return Flight(run=run, wanted_deg=wished.drive, log=log)


def _columns(schedule: Schedule) -> dict[str, Any]:
    return {name: getattr(schedule, name) for name in schedule.__dataclass_fields__}
