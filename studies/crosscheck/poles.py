"""Poles identified from MuJoCo's own steps.

Every node in turn is twisted by a small angle and let go; MuJoCo steps them all.
The map from one set of angles to the next is X_{k+1} X_k^{-1}; its eigenvalues are
exp(p h). Nothing here knows the matrices of the chain.
"""

import math

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from models.drive import Drive, DriveKind
from models.modes import InsertedNeedle
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh
from sim.simulation import compile_model
from sim.spec import Setup
from studies.crosscheck.findings import Check, Pole

Array = NDArray[np.float64]

LENGTHS_MM = (50.0, 100.0, 200.0)
FREE_MM = (0.0, 50.0)
COUNT = 4
BOUND = 0.005
_DAMPING = 0.01725  # N mm s / rad / mm, Table II
_TWIST_RAD = 0.1
_SETTLING = 2  # steps before the map is read: inertia forgets that it was at rest
# Fraction of the fastest wanted pole's time constant that a step takes. The method's
# own error is then 0.04 (0.02)^2, two orders below the bound.
_RESOLUTION = 0.02


def measure(setup: Setup, count: int) -> Array:
    """The slowest `count` poles other than 0, rad/s, slowest first."""
    rough = _poles_at(setup, 1e-3 * (setup.inserted_mm / 200.0) ** 2)[:count]
    return _poles_at(setup, _RESOLUTION / abs(float(rough[-1])))[:count]


def _poles_at(setup: Setup, step_s: float) -> Array:
    fine = setup.discretisation.but(step_s=step_s)
    setup = Setup(**{**_fields(setup), "discretisation": fine})
    model = compile_model(setup)
    shapes = _released(model, setup)
    step = np.linalg.solve(shapes[-2].T, shapes[-1].T).T
    multipliers = np.linalg.eigvals(step)
    real = np.sort(multipliers.real[(np.abs(multipliers.imag) < 1e-9) & (multipliers.real > 1e-3)])[::-1]
    poles: Array = np.log(real) / step_s
    return poles[poles < -1e-6 / step_s]


def _fields(setup: Setup) -> dict[str, object]:
    return {name: getattr(setup, name) for name in setup.__dataclass_fields__}


def _released(model: mujoco.MjModel, setup: Setup) -> Array:
    """Angles after each step, (steps, nodes, releases): column j had node j twisted."""
    nodes = model.nq - 1
    batch = Batch(model, nodes, 1)
    batch.reset(stage=int(mujoco.mjtStage.mjSTAGE_NONE))
    for j in range(nodes):
        angles = np.zeros(nodes)
        angles[j] = _TWIST_RAD
        batch.qpos[j, 1:] = np.diff(angles, prepend=0.0)
    ctrl = np.zeros(model.nu)
    ctrl[model.actuator("inserted").id] = setup.inserted_mm * 1e-3
    # The servo holds the base where it is: at 0, also for the release of the base.
    steps = _SETTLING + 2
    qpos = batch.rollout(steps, np.broadcast_to(ctrl, (nodes, steps, model.nu)))["qpos"]
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


def compare_poles(lengths_mm: tuple[float, ...] = LENGTHS_MM) -> list[Pole]:
    """The slowest four poles at the default discretisation, in every case."""
    poles = []
    for length in lengths_mm:
        for free in FREE_MM:
            for kind in DriveKind:
                expected = closed_form_needle(length, free, kind).poles_with_inertia_rad_s(COUNT + 1)
                expected = expected[expected < 0][:COUNT]
                measured = measure(chain(length, free, kind), COUNT)
                poles += [
                    Pole(
                        length_mm=length,
                        free_mm=free,
                        drive=kind.value,
                        mode=k + 1,
                        measured=float(measured[k]),
                        closed_form=float(expected[k]),
                    )
                    for k in range(COUNT)
                ]
    return poles


def check_poles(poles: list[Pole]) -> Check:
    """The worst pole."""
    worst = max(poles, key=lambda pole: pole.error)
    return Check(
        name=f"worst pole: mode {worst.mode}, {worst.length_mm:g} mm, {worst.drive} driven",
        value=worst.error,
        unit="-",
        high=BOUND,
        why="0.5 % at the default discretisation",
    )


def order_in_elements() -> list[Check]:
    """Order of convergence of the fourth pole as the elements shrink."""
    bounds = {
        DriveKind.ANGLE: (3.7, 4.5, "error x^4 / 240 + O(x^6) between a held base and a free tip"),
        DriveKind.TORQUE: (1.9, 4.5, "a covered end that is neither costs two orders"),
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
    exact = closed_form_needle(length, 0.0, kind).poles_with_inertia_rad_s(COUNT + 1)
    expected = exact[exact < 0][COUNT - 1]
    coarse, fine = (
        abs(measure(chain(length, 0.0, kind, elements=n), COUNT)[COUNT - 1] / expected - 1)
        for n in (8, 16)
    )
    return math.log2(coarse / fine)
