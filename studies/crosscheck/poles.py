"""Poles of MuJoCo's needles, by source, beside those of the continuous needle.

A source is a needle and the method of its steps: ours with second-order steps, ours with MuJoCo's
first-order step, and one made of MuJoCo's own springs and dampers. Each has its own bound.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from models.drive import Drive, DriveKind
from models.modes import InsertedNeedle
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh
from sim.needles.kept import compile_model
from sim.needles.setup import Setup
from studies.crosscheck import native_needle
from studies.crosscheck.findings import Check, Pole, PoleSource
from studies.crosscheck.identification import (
    PoleOfMultiplier,
    pole_of_backward_euler,
    pole_of_exact_step,
    slow_poles_rad_s,
)

Array = NDArray[np.float64]

LENGTHS_MM = (50.0, 100.0, 200.0)
FREE_MM = (0.0, 50.0)
COUNT = 4
BOUND = 0.005
_DAMPING = 0.01725  # N mm s / rad / mm, Table II
_TWIST_RAD = 0.1
# Fraction of the fastest wanted pole's time constant that a step takes. The second-order
# method's own error is then 0.04 (0.02)^2, two orders below the bound.
_RESOLUTION = 0.02
# No error of backward Euler's step is left: long steps, in which the free end's inertia settles.
_NATIVE_RESOLUTION = 0.5


def measure(setup: Setup, count: int, *, pole_of: PoleOfMultiplier = pole_of_exact_step) -> Array:
    """The slowest `count` poles of our needle other than 0, rad/s, slowest first.

    Args:
      pole_of: the pole of an eigenvalue, by the method of the step.
    """
    return slow_poles_rad_s(
        lambda step_s, steps: _released(setup, step_s, steps),
        pole_of,
        count=count,
        resolution=_RESOLUTION,
        guess_s=_guess_s(setup.inserted_mm),
    )


def measure_native(rig: InsertedNeedle, count: int, *, elements: int = native_needle.ELEMENTS) -> Array:
    """The slowest `count` poles of the needle without a callback other than 0, rad/s, slowest first."""
    return slow_poles_rad_s(
        lambda step_s, steps: native_needle.released(rig, step_s=step_s, steps=steps, elements=elements),
        pole_of_backward_euler,
        count=count,
        resolution=_NATIVE_RESOLUTION,
        guess_s=_guess_s(rig.inserted_mm),
    )


def _guess_s(length_mm: float) -> float:
    """A step, s, for a first guess of the slowest poles, which scale with 1 / length^2."""
    return 1e-3 * (length_mm / 200.0) ** 2


def _released(setup: Setup, step_s: float, steps: int) -> Array:
    """Angles after each step, (steps, nodes, releases); in column j, node j was twisted and released."""
    model = compile_model(replace(setup, discretisation=setup.discretisation.but(step_s=step_s)))
    nodes = model.nq - 1
    batch = Batch(model, nodes, 1)
    batch.reset(stage=int(mujoco.mjtStage.mjSTAGE_NONE))
    batch.qpos[:, 1:] = np.diff(_TWIST_RAD * np.eye(nodes), prepend=0.0)
    ctrl = np.zeros((nodes, steps, model.nu))
    # The servo holds the base where it is: at 0, also for the release of the base.
    ctrl[:, :, model.actuator("inserted").id] = setup.inserted_mm * 1e-3
    qpos = batch.rollout(steps, ctrl)["qpos"]
    return np.cumsum(qpos[:, :, 1:], axis=2).transpose(1, 2, 0)


def closed_form_needle(length_mm: float, free_mm: float, kind: DriveKind) -> InsertedNeedle:
    """The closed form of one case."""
    return InsertedNeedle(
        needle=NITINOL,
        damping_n_mm_s_per_mm=_DAMPING,
        inserted_mm=length_mm,
        free_mm=free_mm,
        drive=kind,
    )


def chain(length_mm: float, free_mm: float, kind: DriveKind, **discretisation: int) -> Setup:
    """MuJoCo's needle of one case."""
    return Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=_DAMPING),
        drive=Drive(kind=kind),
        discretisation=Discretisation(**discretisation),
        mesh=Mesh.EULERIAN,
        free_mm=free_mm,
        inserted_mm=length_mm,
    )


@dataclass(frozen=True, kw_only=True)
class PoleMeasurement:
    """How the poles of one source are measured, and their accepted error.

    Attributes:
      measure: length, mm; free length, mm; drive -> the slowest `COUNT` poles, rad/s.
      bound: largest relative error of any of them.
      why: origin of the bound.
    """

    measure: Callable[[float, float, DriveKind], Array]
    bound: float
    why: str


SOURCES = {
    PoleSource.SECOND_ORDER: PoleMeasurement(
        measure=lambda *case: measure(chain(*case), COUNT),
        bound=BOUND,
        why="0.5 % at the default discretisation",
    ),
    PoleSource.FIRST_ORDER: PoleMeasurement(
        measure=lambda *case: measure(chain(*case, order=1), COUNT),
        bound=BOUND + _RESOLUTION / 2,
        why="0.5 % from the elements, and h |p| / 2 from the step: h |p| = 0.02 for the fourth pole",
    ),
    PoleSource.NATIVE: PoleMeasurement(
        measure=lambda *case: measure_native(closed_form_needle(*case), COUNT),
        bound=native_needle.pole_bound(COUNT),
        why=f"lumped: (4 pi / 2n)^2 / 3 with n = {native_needle.ELEMENTS}; no error from the step",
    ),
}


def compare_poles(lengths_mm: tuple[float, ...] = LENGTHS_MM) -> list[Pole]:
    """The slowest four poles of every source, in every case."""
    return [
        Pole(
            source=source,
            length_mm=length,
            free_mm=free,
            drive=kind.value,
            mode=k + 1,
            measured=float(measured),
            closed_form=float(expected),
            bound=how.bound,
        )
        for source, how in SOURCES.items()
        for length in lengths_mm
        for free in FREE_MM
        for kind in DriveKind
        for k, (measured, expected) in enumerate(
            zip(how.measure(length, free, kind), expected_poles(length, free, kind), strict=True)
        )
    ]


def expected_poles(length_mm: float, free_mm: float, kind: DriveKind) -> Array:
    """The slowest `COUNT` poles of the closed form other than 0, rad/s."""
    poles = closed_form_needle(length_mm, free_mm, kind).poles_with_inertia_rad_s(COUNT + 1)
    return poles[poles < 0][:COUNT]


def check_poles(poles: list[Pole]) -> list[Check]:
    """The worst pole of every source."""
    by_source = {source: [pole for pole in poles if pole.source is source] for source in SOURCES}
    return [_check_worst(source, found) for source, found in by_source.items() if found]


def _check_worst(source: PoleSource, poles: list[Pole]) -> Check:
    worst = max(poles, key=lambda pole: pole.error)
    of = "" if source is PoleSource.SECOND_ORDER else f", {source.words}"
    return Check(
        name=f"worst pole{of}: mode {worst.mode}, {worst.length_mm:g} mm, {worst.drive} driven",
        value=worst.error,
        unit="-",
        high=SOURCES[source].bound,
        why=SOURCES[source].why,
    )


def order_in_elements() -> list[Check]:
    """Order of convergence of the fourth pole with the length of the elements."""
    bounds = {
        DriveKind.ANGLE: (3.7, 4.5, "error x^4 / 240 + O(x^6) between a held base and a free tip"),
        DriveKind.TORQUE: (1.9, 4.5, "any other covered end costs two orders"),
    }
    return [
        Check(
            name=f"order of convergence in elements, 8 to 16, {kind.value} driven",
            value=_order(kind),
            unit="-",
            low=low,
            high=high,
            why=why,
        )
        for kind, (low, high, why) in bounds.items()
    ]


def _order(kind: DriveKind) -> float:
    length = LENGTHS_MM[-1]
    expected = expected_poles(length, 0.0, kind)[-1]
    coarse, fine = (
        abs(measure(chain(length, 0.0, kind, elements=n), COUNT)[COUNT - 1] / expected - 1)
        for n in (8, 16)
    )
    return math.log2(coarse / fine)
