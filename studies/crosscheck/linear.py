"""MuJoCo's needle in the two other linear cases with a closed form: yielding tissue, drag at the tip.

Yielding tissue has its own twist, which the angles at one time do not show, but those at two
times do. So the poles are identified from angles alone, by the eigensystem realisation algorithm
(Juang and Pappa 1985): in one run per node, that node is twisted by a small angle and released;
with S_k the angles after k steps, (nodes, releases),

    H_k = [[S_k, S_k+j], [S_k+j, S_k+2j]],        H_k+1 = M H_k,

where the eigenvalues of M are exp(p h). A needle with a given torque has no free length here:
free shaft would then carry no torque and add no pole.
"""

from dataclasses import replace

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from models.drive import Drive, DriveKind
from models.kelvin_voigt_modes import YieldingTissueNeedle
from models.materials import tissue_named
from models.modes import InsertedNeedle
from models.needle import NITINOL, Needle
from models.tip_drag_modes import TipDragNeedle
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh
from sim.needles.kept import compile_model
from sim.needles.setup import Setup
from sim.simulation import simulate
from studies.crosscheck.findings import Check
from studies.crosscheck.motion import base_turn
from studies.crosscheck.poles import BOUND, COUNT, measure

Array = NDArray[np.float64]

LENGTHS_MM = (100.0, 200.0)
CASES = ((DriveKind.ANGLE, 0.0), (DriveKind.ANGLE, 50.0), (DriveKind.TORQUE, 0.0))
YIELDING = tissue_named("soft-plastisol")
DRAGGED = NITINOL.but(tip_drag_n_mm_s_per_rad=0.345)
"""The tip resists as much as 2 cm of shaft in the paper's plastisol."""
RESPONSE_BOUND_DEG = 0.01
CREEP_BOUND = 0.25 * BOUND
"""Of the creeping poles, relative: 0.5 % of kappa w^2, of which they take a quarter at most."""
_TWIST_RAD = 0.1
_SETTLING = 2  # steps before the first sample: inertia forgets that it was at rest
# Share of the fastest wanted pole's time constant that a step takes (the method's own error is
# then 0.04 (0.05)^2 = 0.01 %), and of the slowest one's that lies between the two instants.
_RESOLUTION, _APART = 0.05, 0.5
_ROUNDING = 1e-9  # singular values below this share of the largest are rounding


def needle_setup(
    length_mm: float,
    free_mm: float,
    kind: DriveKind,
    *,
    needle: Needle = NITINOL,
    tissue: Tissue = YIELDING,
    **discretisation: float,
) -> Setup:
    """MuJoCo's needle of one case, at the default discretisation except for what is given."""
    return Setup(
        needle=needle,
        tissue=tissue,
        drive=Drive(kind=kind),
        discretisation=Discretisation(**discretisation),
        mesh=Mesh.EULERIAN,
        free_mm=free_mm,
        inserted_mm=length_mm,
    )


def _viscous_setup(length_mm: float, free_mm: float, kind: DriveKind) -> Setup:
    """A needle with drag at its tip, in purely viscous tissue."""
    viscous = Tissue.uniform(viscous_n_mm_s_per_mm=YIELDING.layers[0].interface.viscous_n_mm_s_per_mm)
    return needle_setup(length_mm, free_mm, kind, needle=DRAGGED, tissue=viscous)


def _viscous(length_mm: float, free_mm: float, kind: DriveKind) -> InsertedNeedle:
    return InsertedNeedle(
        needle=NITINOL,
        damping_n_mm_s_per_mm=YIELDING.layers[0].interface.viscous_n_mm_s_per_mm,
        inserted_mm=length_mm,
        free_mm=free_mm,
        drive=kind,
    )


def yielding(length_mm: float, free_mm: float, kind: DriveKind) -> YieldingTissueNeedle:
    """The closed form of one case in soft plastisol."""
    law = YIELDING.layers[0].interface
    return YieldingTissueNeedle(
        viscous=_viscous(length_mm, free_mm, kind),
        stiffness_n_mm_per_rad_per_mm=law.stiffness_n_mm_per_rad_per_mm or 0.0,
        time_constant_s=law.time_constant_s,
    )


def dragged(length_mm: float, free_mm: float, kind: DriveKind) -> TipDragNeedle:
    """The closed form of one case with drag at the tip."""
    return TipDragNeedle(
        shaft=_viscous(length_mm, free_mm, kind),
        tip_drag_n_mm_s_per_rad=DRAGGED.tip_drag_n_mm_s_per_rad,
    )


def linear_checks() -> list[Check]:
    """Poles and responses in yielding tissue and with drag at the tip."""
    slow, fast = (
        np.array([pole_errors(length, free, kind) for length in LENGTHS_MM for kind, free in CASES])
        .max(axis=0)
        .tolist()
    )
    drag = max(_drag_error(length, free, kind) for length in LENGTHS_MM for kind, free in CASES)
    why = "0.5 % at the default discretisation, as in viscous tissue"
    return [
        Check(
            name="worst creeping pole in soft plastisol",
            value=slow,
            unit="-",
            high=CREEP_BOUND,
            why="a creeping pole has at most a quarter of the error of kappa w^2, which is 0.5 %",
        ),
        Check(name="worst quick pole in soft plastisol", value=fast, unit="-", high=BOUND, why=why),
        Check(name="worst pole with drag at the tip", value=drag, unit="-", high=BOUND, why=why),
        *check_responses(),
    ]


def pole_errors(length_mm: float, free_mm: float, kind: DriveKind) -> tuple[float, float]:
    """Largest relative error of the first four slow and fast poles in soft plastisol."""
    expected = yielding(length_mm, free_mm, kind)
    found = measure_yielding(needle_setup(length_mm, free_mm, kind), expected)
    first = 0 if kind is DriveKind.ANGLE else 1  # the first mode of a given torque is no torsion
    pairs = zip(found, expected.poles_rad_s(first + COUNT)[first:].T, strict=True)
    slow, fast = (float(np.abs(measured / exact - 1).max()) for measured, exact in pairs)
    return slow, fast


def measure_yielding(setup: Setup, expected: YieldingTissueNeedle) -> tuple[Array, Array]:
    """The first four slow and fast poles of MuJoCo's needle, rad/s, slowest first.

    Args:
      expected: poles that set the step and separate slow from fast; they do not enter the result.
    """
    first = 0 if setup.drive.kind is DriveKind.ANGLE else 1
    fast = expected.poles_rad_s(first + COUNT)[first:, 1]
    step_s = float(_RESOLUTION / abs(fast[-1]))
    apart = int(_APART / abs(fast[0]) / step_s)
    fine = setup.discretisation.but(step_s=step_s)
    angles = _released(replace(setup, discretisation=fine), _SETTLING + 2 * apart + 2)
    poles = _realised_poles(angles, apart) / step_s
    # -1/tau is no pole of a shaft that is held; where it turns freely, the tissue alone has it.
    own = -1.0 / expected.time_constant_s
    slow = poles[(poles > 0.5 * (own + expected.creep_limit_rad_s)) & (poles < -1e-3)]
    return slow[:COUNT], poles[poles < 1.1 * own][:COUNT]


def _released(setup: Setup, steps: int) -> Array:
    """Angles after each step, (steps, nodes, releases): column j had node j twisted."""
    model = compile_model(setup)
    nodes = model.nq - 1
    batch = Batch(model, nodes, 1)
    batch.reset(stage=int(mujoco.mjtStage.mjSTAGE_NONE))
    batch.qpos[:, 1:] = np.diff(_TWIST_RAD * np.eye(nodes), axis=1, prepend=0.0)
    ctrl = np.zeros(model.nu)
    ctrl[model.actuator("inserted").id] = setup.inserted_mm * 1e-3
    qpos = batch.rollout(steps, np.broadcast_to(ctrl, (nodes, steps, model.nu)))["qpos"]
    return np.cumsum(qpos[:, :, 1:], axis=2).transpose(1, 2, 0)


def _realised_poles(angles: Array, apart: int) -> Array:
    """Real poles times step of the smallest system with these angles, slowest first."""

    def hankel(k: int) -> Array:
        now, then, later = angles[k], angles[k + apart], angles[k + 2 * apart]
        return np.block([[now, then], [then, later]])

    left, size, right = np.linalg.svd(hankel(_SETTLING))
    kept = size > _ROUNDING * size[0]
    step = left[:, kept].T @ hankel(_SETTLING + 1) @ right[kept].T / size[kept]
    values = np.linalg.eigvals(step)
    real = values.real[(np.abs(values.imag) < 1e-9) & (values.real > 1e-3)]
    return np.sort(np.log(real))[::-1]


def _drag_error(length_mm: float, free_mm: float, kind: DriveKind) -> float:
    """Largest relative error of the first four poles with drag at the tip."""
    measured = measure(_viscous_setup(length_mm, free_mm, kind), COUNT)
    first = 0 if kind is DriveKind.ANGLE else 1
    exact = dragged(length_mm, free_mm, kind).poles_rad_s(first + COUNT)[first:]
    return float(np.abs(measured / exact - 1).max())


def response_error_deg(setup: Setup, exact: YieldingTissueNeedle | TipDragNeedle) -> float:
    """Largest difference of the tip from the closed form, 90 deg in 0.3 s, held to 8 s, deg."""
    time, angle = np.array([0.0, 0.3, 8.0]), np.array([0.0, 90.0, 90.0])
    turn = base_turn(time, angle, inserted_mm=setup.inserted_mm, free_mm=setup.free_mm)
    run = simulate([setup], turn)[0]
    tip = exact.respond(run.time_s, np.radians(run.inputs.drive), count=200).tip_rad
    return float(np.abs(run.tip_deg - np.degrees(tip)).max())


def check_responses() -> list[Check]:
    """The fast turn of a needle 20 cm deep, at the default discretisation."""
    depth, kind = LENGTHS_MM[-1], DriveKind.ANGLE
    why = "step: 0.0043 deg at each corner of the turn; elements: at most 0.3 % of poles, 0.003 deg"
    return [
        Check(
            name=f"tip on the 20 cm turn, {what}, {free:g} mm free",
            value=response_error_deg(build(depth, free, kind), exact(depth, free, kind)),
            unit="deg",
            high=RESPONSE_BOUND_DEG,
            why=why,
        )
        for what, build, exact in (
            ("soft plastisol", needle_setup, yielding),
            ("drag at the tip", _viscous_setup, dragged),
        )
        for free in (0.0, 50.0)
    ]
