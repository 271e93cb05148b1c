"""The step response of a tip controller on the MuJoCo needle, and its metrics.

The reference steps by 90 deg. Settling is the time after which the tip stays within 3 deg; the
integral is that of (reference - tip) over 2 s, signed. The paper does not state its free length;
two are run: none, and the 50 mm of its set-up, which grow as the needle retracts at 2.5 mm/s.
"""

from dataclasses import dataclass

import numpy as np

from models import published, units
from models.drive import Drive, DriveKind
from models.materials import MATERIALS, slope_per_mm
from models.needle import NITINOL, Needle
from models.tissue import Tissue
from sim.closed_loop import ClosedLoopRun, MeasurementNoise, run_closed_loop
from sim.discretisation import Discretisation
from sim.kernel import memory_map
from sim.loop.hardware import LoopHardware
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.schedule import Schedule
from studies.control.tip_controllers import ControllerDesign, tip_controller_named
from studies.crosscheck.paper import integral_deg_s, settling_s

HOLD_S = 9.0
SPEED_MM_S = -2.5
_STEP_DEG, _START_S, _STEP_S = 90.0, 0.1, 0.002

DAMPING = slope_per_mm(dict(published.DAMPING_PLASTISOL_N_MM_S))
DESIGN = ControllerDesign(needle=NITINOL, damping_n_mm_s_per_mm=DAMPING)
# Plausible for the sensors of the paper's rig: encoder, six-axis force sensor, Hall sensor.
NOISE = MeasurementNoise(base_deg=0.02, torque_n_mm=0.015, tip_deg=0.2, seed=1)


@dataclass(frozen=True, kw_only=True)
class ControlPlant:
    """A simulated rig, which may differ from the one that the controllers were designed for.

    Attributes:
      needle, tissue, drive, hardware, noise: the simulated rig.
      design: design of the controllers on this rig.
    """

    name: str
    tissue: Tissue = MATERIALS["viscous-plastisol"]
    needle: Needle = NITINOL
    drive: Drive = Drive()  # noqa: RUF009 - frozen
    hardware: LoopHardware = LoopHardware()  # noqa: RUF009 - frozen
    noise: MeasurementNoise | None = NOISE
    design: ControllerDesign = DESIGN


def step_reference(
    depth_mm: float, free_mm: float, *, speed_mm_s: float, hold_s: float = HOLD_S
) -> Schedule:
    """A step of the reference, at a depth, while the needle slides."""
    time = np.array([0.0, _START_S, _START_S + 1e-6, _START_S + hold_s])
    return Schedule(
        time_s=time,
        drive=np.array([0.0, 0.0, _STEP_DEG, _STEP_DEG]),
        free_mm=free_mm - speed_mm_s * time,
        inserted_mm=np.full(4, depth_mm),
        speed_mm_s=np.full(4, speed_mm_s),
    )


def step_on(
    plant: ControlPlant,
    controller: str,
    *,
    depth_cm: float,
    free_mm: float,
    hold_s: float = HOLD_S,
    keep_shape: bool = False,
) -> ClosedLoopRun:
    """One step of the reference, with one controller on one rig."""
    tip_controller = tip_controller_named(controller, plant.design)
    setup = Setup(
        needle=plant.needle,
        tissue=plant.tissue,
        drive=plant.drive,
        discretisation=Discretisation(step_s=_STEP_S),
        free_mm=free_mm,
        inserted_mm=10 * depth_cm,
    )
    speed = SPEED_MM_S if free_mm > 0 else 0.0
    return run_closed_loop(
        setup,
        step_reference(10 * depth_cm, free_mm, speed_mm_s=speed, hold_s=hold_s),
        tip_controller,
        noise=plant.noise,
        hardware=plant.hardware,
        log=tip_controller.signals,
        keep_shape=keep_shape,
    )


def turn(
    controller: str,
    *,
    depth_cm: float,
    free_mm: float,
    tissue: Tissue,
    design: ControllerDesign = DESIGN,
    noise: MeasurementNoise | None = NOISE,
    hold_s: float = HOLD_S,
) -> ClosedLoopRun:
    """One step of the reference on a rig with ideal hardware."""
    plant = ControlPlant(
        name=tissue.name, tissue=tissue, needle=design.needle, noise=noise, design=design
    )
    return step_on(plant, controller, depth_cm=depth_cm, free_mm=free_mm, hold_s=hold_s)


def response_metrics(run: Run) -> tuple[float, float, float, float]:
    """Settling, s; integral, deg s; overshoot of the tip and largest base angle, deg."""
    after = run.time_s >= _START_S - 1e-9
    time, error = run.time_s[after], _STEP_DEG - run.tip_deg[after]
    driven_by_angle = run.setup.drive.kind is DriveKind.ANGLE
    base = run.inputs.drive if driven_by_angle else run.base_deg
    return (
        settling_s(time, error),
        integral_deg_s(time, error),
        max(0.0, float(-error.min())),
        float(base.max()),
    )


def largest_shear_stress_mpa(run: Run) -> float:
    """Largest shear stress at the surface of the shaft, over all elements and times, MPa."""
    torque_n_mm = float(run.outputs[:, memory_map.O_SHAFT_TORQUE].max()) / units.N_MM
    return run.setup.needle.shear_stress_mpa(torque_n_mm)


def final_error_deg(run: Run) -> float:
    """Largest error of the tip in the last second, deg."""
    last = run.time_s >= run.time_s[-1] - 1.0
    return float(np.abs(_STEP_DEG - run.tip_deg[last]).max())
