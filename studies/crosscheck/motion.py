"""Runs checked against closed-form solutions, and balances of torque and energy."""

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

from models.drive import DriveKind
from models.lag import steady_lag_deg
from models.materials import (
    tissue_named,
    tissue_stiffness_n_mm_per_rad_per_mm,
    tissue_time_constant_s,
)
from models.modes import InsertedNeedle
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation, Mesh
from sim.kernel import memory_map
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.paper_protocols import protocol_named
from sim.schedule import Schedule
from sim.simulation import simulate
from studies.crosscheck.findings import Check

Array = NDArray[np.float64]

_DAMPING = 0.01725
_LENGTH_MM = 200.0
TURN_S, HOLD_S = 0.3, 8.0
_CURVATURE_DEG_S = 99.0  # most of |t theta_tt| on the fast turn


def base_turn(time_s: Array, angle_deg: Array, *, inserted_mm: float, free_mm: float = 0.0) -> Schedule:
    """The base alone moves."""
    still = np.ones_like(time_s)
    return Schedule(
        time_s=time_s,
        drive=angle_deg,
        free_mm=free_mm * still,
        inserted_mm=inserted_mm * still,
        speed_mm_s=0 * still,
    )


def viscous_setup(*, free_mm: float = 0.0, **discretisation: object) -> Setup:
    """The paper's needle 20 cm deep in purely viscous tissue."""
    return Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=_DAMPING),
        discretisation=Discretisation(**discretisation),
        mesh=Mesh.EULERIAN,
        free_mm=free_mm,
        inserted_mm=_LENGTH_MM,
    )


def fast_turn(*, free_mm: float = 0.0) -> Schedule:
    """A turn by 90 deg in 0.3 s, then held: 8 s in all."""
    time = np.array([0.0, TURN_S, HOLD_S])
    return base_turn(time, np.array([0.0, 90.0, 90.0]), inserted_mm=_LENGTH_MM, free_mm=free_mm)


def exact_tip_deg(run: Run) -> Array:
    """Tip of the closed form for a viscous, base-driven run, deg, (N,)."""
    response = closed_form(run.setup).respond(run.time_s, np.radians(run.inputs.drive), count=200)
    return np.degrees(response.tip_rad)


def closed_form(setup: Setup) -> InsertedNeedle:
    """The continuous needle of `viscous_setup`."""
    return InsertedNeedle(
        needle=setup.needle,
        damping_n_mm_s_per_mm=_DAMPING,
        inserted_mm=_LENGTH_MM,
        free_mm=setup.free_mm,
        drive=DriveKind.ANGLE,
    )


def tip_error_deg(setup: Setup, schedule: Schedule) -> float:
    """Largest difference of the tip from the closed form over a run, deg."""
    run = simulate([setup], schedule)[0]
    return float(np.abs(run.tip_deg - exact_tip_deg(run)).max())


def order_in_step() -> list[Check]:
    """Order of convergence in the step on a turn without corners, of both methods."""
    time = np.linspace(0.0, 4.0, 4001)
    smooth = 45 * (1 - np.cos(np.pi * np.clip(time / 2, 0, 1)))
    schedule = base_turn(time, smooth, inserted_mm=_LENGTH_MM)

    def found(order: int, steps_s: tuple[float, float]) -> float:
        coarse, fine = (
            tip_error_deg(viscous_setup(elements=48, step_s=h, order=order), schedule) for h in steps_s
        )
        return math.log2(coarse / fine)

    return [
        Check(
            name="order of convergence in the step, 80 to 40 ms",
            value=found(2, (0.08, 0.04)),
            unit="-",
            low=1.8,
            high=2.4,
            why="the method is of second order; a smooth turn of 2 s",
        ),
        Check(
            name="order of convergence in the step, first order, 10 to 5 ms",
            value=found(1, (0.01, 0.005)),
            unit="-",
            low=0.95,
            high=1.05,
            why="MuJoCo's own step is of first order; the same turn",
        ),
    ]


def check_first_order_turn() -> Check:
    """The fast turn by MuJoCo's own first-order step: it converges to the same result."""
    step_s = 0.001
    error = tip_error_deg(viscous_setup(order=1, step_s=step_s), fast_turn())
    return Check(
        name="tip on the 20 cm turn, 0 mm free, first order, 1 ms",
        value=error,
        unit="deg",
        high=0.5 * step_s * _CURVATURE_DEG_S + 0.02,
        why="h / 2 times |t theta_tt| <= 99 deg/s on this turn, and 0.02 deg from the elements",
    )


def check_arrangements() -> Check:
    """Check that chain and siblings give the same angles."""
    schedule = fast_turn()
    chain, siblings = (
        simulate([viscous_setup(arrangement=a)], schedule)[0].tip_deg for a in Arrangement
    )
    return Check(
        name="tip, as siblings and as a chain",
        value=float(np.abs(chain - siblings).max()),
        unit="deg",
        high=1e-8,
        why="the same step with another arrangement of bodies: only rounding differs",
    )


def check_steady_twist() -> list[Check]:
    """Twist and torque at a constant rate, against (2) and tau = b omega (25)."""
    rate_deg_s = 4.5
    time = np.array([0.0, 40.0])
    schedule = base_turn(time, rate_deg_s * time, inserted_mm=_LENGTH_MM, free_mm=50.0)
    run = simulate([viscous_setup(free_mm=50.0)], schedule)[0]
    lag = steady_lag_deg(
        NITINOL,
        damping_n_mm_s_per_mm=_DAMPING,
        rate_rad_s=math.radians(rate_deg_s),
        free_mm=50.0,
        inserted_mm=_LENGTH_MM,
    )
    torque = _DAMPING * _LENGTH_MM * math.radians(rate_deg_s)
    # The slowest transient, exp(-0.75 40 s), is 1e-13; the servo gives 1e-6 of the lag.
    return [
        Check(
            name="steady lag at 4.5 deg/s over eq. (2)",
            value=float((run.inputs.drive[-1] - run.tip_deg[-1]) / lag),
            unit="-",
            low=1 - 1e-5,
            high=1 + 1e-5,
            why="linear elements are exact for steady twist; the servo yields by 1e-6",
        ),
        Check(
            name="steady torque at 4.5 deg/s over b omega",
            value=float(run.base_torque_n_mm[-1] / torque),
            unit="-",
            low=1 - 1e-5,
            high=1 + 1e-5,
            why="equation (25); the servo yields by 1e-6",
        ),
    ]


def elastic_gelatin() -> Tissue:
    """Gelatin with the elasticity of plastisol: the paper does not state gelatin's own."""
    return Tissue.uniform(
        name="gelatin, elastic as plastisol",
        shared_n_mm_per_mm=tissue_named("porcine-gelatin").layers[0].interface.shared_n_mm_per_mm,
        stiffness_n_mm_per_rad_per_mm=tissue_stiffness_n_mm_per_rad_per_mm(),
        time_constant_s=tissue_time_constant_s(),
    )


@cache
def reversal(tissue: Tissue) -> Run:
    """Fig. 4 at 10 cm."""
    protocol = protocol_named("fig4-10cm").but(tissue=tissue)
    return simulate([protocol.setup()], protocol.schedule(), keep_shape=True)[0]


def check_balances() -> list[Check]:
    """Torque and energy in dry, yielding tissue: the run of Fig. 4 at 10 cm."""
    run = reversal(elastic_gelatin())
    out = run.outputs
    peak = np.abs(out[:, memory_map.O_BASE_TORQUE]).max()
    imbalance = np.abs(out[:, memory_map.O_BASE_TORQUE] - out[:, memory_map.O_FRICTION]).max() / peak
    dissipated = out[:, memory_map.O_DISSIPATED]
    created = -min(0.0, float(np.diff(dissipated).min())) / dissipated[-1]
    stored = out[:, memory_map.O_TISSUE_ENERGY] + _strain_energy_j(run)
    closed = (
        np.abs(out[:, memory_map.O_WORK] - dissipated - stored).max() / out[:, memory_map.O_WORK].max()
    )
    return [
        Check(
            name="base torque minus sum of friction (Fig. 4, 10 cm)",
            value=float(imbalance),
            unit="-",
            high=1e-6,
            why="the inertia of the needle needs less than 1e-6 of the torque",
        ),
        Check(
            name="energy created by tissue in any step, over its total dissipation",
            value=created,
            unit="-",
            high=1e-4,
            why="presliding stores level z_y / 2 per mm and returns it: below 1e-4",
        ),
        Check(
            name="work of the drive minus dissipation and storage, over the work",
            value=float(closed),
            unit="-",
            high=1e-4,
            why="zero, except for presliding and the quadrature of the stages",
        ),
        Check(
            name="stages that did not converge",
            value=run.unconverged,
            unit="-",
            high=0,
            why="Newton's method must converge in every stage",
        ),
    ]


def _strain_energy_j(run: Run) -> Array:
    """Elastic energy of torsion in the shaft, J, (N,)."""
    assert run.angles_rad is not None
    lengths = np.diff(run.setup.nodes_mm) * 1e-3
    twist = np.diff(run.angles_rad, axis=1)
    free = run.inputs.free_mm[:, None] * 1e-3
    stretch = run.setup.stretching
    now = np.tile(lengths, (len(twist), 1))
    now[:, :stretch] *= free / (run.setup.free_mm * 1e-3)
    rigidity = run.setup.needle.rigidity_n_mm2 * 1e-6
    energy: Array = 0.5 * rigidity * (twist**2 / now).sum(axis=1)
    return energy


def reversal_lead_deg(tissue: Tissue) -> float:
    """Fig. 4 at 10 cm: how far the tip turns back before the base overtakes it, deg."""
    run = reversal(tissue)
    held = run.time_s >= 30.0 - 1e-9
    base, tip = run.inputs.drive[held], run.tip_deg[held]
    overtaken = int(np.argmax(base < tip))
    return float(tip[0] - tip[overtaken])
