"""Tables IV and V on the MuJoCo needle, and their robustness to tissue that is not modelled.

The reference steps by 90 deg. Settling is the time after which the tip stays within
3 deg; the integral is that of (reference - tip) over 2 s, signed. The paper does not say
which free length it had; two are run: none, and the 50 mm of its set-up, which grow as
the needle retracts at 2.5 mm/s.
"""

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from models import published
from models.materials import MATERIALS, slope_per_mm
from models.needle import NITINOL
from models.tissue import Interface, Layer, Tissue
from sim.closed_loop import ClosedLoopRun, MeasurementNoise, run_closed_loop
from sim.discretisation import Discretisation
from sim.schedule import Schedule
from sim.simulation import Run
from sim.spec import Setup
from studies.control.tip_controllers import ControllerDesign, tip_controller_named
from studies.crosscheck.paper import integral_deg_s, settling_s

DEPTHS_CM = (5.0, 10.0, 20.0)
FREE_MM = (0.0, 50.0)
CONTROLLERS = (
    "base_only",
    "base_only_at_limit",
    "feedforward",
    "feedback",
    "paper_reading",
    "lqr",
    "least_time",
)
_PUBLISHED = ("base_only", "feedforward", "feedback")
_STEP_DEG, _START_S, HOLD_S = 90.0, 0.1, 9.0
_SPEED_MM_S = -2.5
_STEP_S = 0.002
DAMPING = slope_per_mm(dict(published.DAMPING_PLASTISOL_N_MM_S))
DESIGN = ControllerDesign(needle=NITINOL, damping_n_mm_s_per_mm=DAMPING)
# Plausible for the sensors of the paper's rig: encoder, six-axis force sensor, Hall sensor.
NOISE = MeasurementNoise(base_deg=0.02, torque_n_mm=0.015, tip_deg=0.2, seed=1)


@dataclass(frozen=True, kw_only=True)
class StepResponse:
    """Metrics of the step response of one controller on one needle.

    Attributes:
      settle_s: NaN where the tip does not settle within 9 s.
      settle_better, integral_better: improvement on base_only, %.
      published_settle_s, published_integral_deg_s: of the paper, where it has them.
    """

    tissue: str
    depth_cm: float
    free_mm: float
    controller: str
    settle_s: float
    integral_deg_s: float
    overshoot_deg: float
    largest_base_deg: float
    settle_better: float
    integral_better: float
    published_settle_s: float = math.nan
    published_integral_deg_s: float = math.nan

    @property
    def worse_than_none(self) -> bool:
        """Whether the response is worse than with the base alone."""
        slower = self.settle_better < 0 or self.integral_better < 0
        return self.controller != "base_only" and (slower or self.overshoot_deg > _WORST_OVERSHOOT_DEG)


_WORST_OVERSHOOT_DEG = 10.0


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
    """One step of the reference, with one controller."""
    tip_controller = tip_controller_named(controller, design)
    setup = Setup(
        needle=design.needle,
        tissue=tissue,
        discretisation=Discretisation(step_s=_STEP_S),
        free_mm=free_mm,
        inserted_mm=10 * depth_cm,
    )
    speed = _SPEED_MM_S if free_mm > 0 else 0.0
    inputs = step_reference(10 * depth_cm, free_mm, speed_mm_s=speed, hold_s=hold_s)
    return run_closed_loop(setup, inputs, tip_controller, noise=noise, log=tip_controller.signals)


def response_metrics(run: Run) -> tuple[float, float, float, float]:
    """Settling, s; integral, deg s; overshoot of the tip and largest base angle, deg."""
    after = run.time_s >= _START_S - 1e-9
    time, error = run.time_s[after], _STEP_DEG - run.tip_deg[after]
    return (
        settling_s(time, error),
        integral_deg_s(time, error),
        max(0.0, float(-error.min())),
        float(run.inputs.drive.max()),
    )


def compare(
    tissue: Tissue,
    *,
    depth_cm: float,
    free_mm: float,
    controllers: tuple[str, ...] = CONTROLLERS,
    design: ControllerDesign = DESIGN,
    hold_s: float = HOLD_S,
) -> list[StepResponse]:
    """Every controller on one needle; improvements are relative to the first.

    Args:
      hold_s: how long the reference is held: a tip that has not settled then never does.
    """
    responses: list[StepResponse] = []
    for name in controllers:
        run = turn(
            name, depth_cm=depth_cm, free_mm=free_mm, tissue=tissue, design=design, hold_s=hold_s
        ).run
        settle, integral, overshoot, base = response_metrics(run)
        baseline = responses[0] if responses else None
        responses.append(
            StepResponse(
                tissue=tissue.name,
                depth_cm=depth_cm,
                free_mm=free_mm,
                controller=name,
                settle_s=settle,
                integral_deg_s=integral,
                overshoot_deg=overshoot,
                largest_base_deg=base,
                settle_better=_better(settle, baseline.settle_s if baseline else settle),
                integral_better=_better(integral, baseline.integral_deg_s if baseline else integral),
                published_settle_s=_printed(tissue, published.TABLE_IV_SETTLE_S, depth_cm, name),
                published_integral_deg_s=_printed(
                    tissue, published.TABLE_V_INTEGRAL_DEG_S, depth_cm, name
                ),
            )
        )
    return responses


def _better(value: float, baseline: float) -> float:
    """Improvement, %: 100 if only the baseline never settles, -100 if only this one."""
    if math.isnan(baseline):
        return 0.0 if math.isnan(value) else 100.0
    return -100.0 if math.isnan(value) else 100.0 * (1.0 - value / baseline)


def _printed(tissue: Tissue, table: Any, depth_cm: float, controller: str) -> float:
    paper_rig = tissue.name == "viscous-plastisol"
    if not paper_rig or controller not in _PUBLISHED or depth_cm not in table:
        return math.nan
    return float(table[depth_cm][_PUBLISHED.index(controller)])


def tables_iv_v() -> list[StepResponse]:
    """Tables IV and V: every depth, both free lengths."""
    viscous = MATERIALS["viscous-plastisol"]
    return [
        response
        for depth in DEPTHS_CM
        for free in FREE_MM
        for response in compare(viscous, depth_cm=depth, free_mm=free)
    ]


def unmodelled_tissues() -> dict[str, Tissue]:
    """Tissues that differ from the viscous one that the estimator assumes."""
    halves = 2.0 / (1.0 + 4.0)
    return {
        tissue.name: tissue
        for tissue in (
            Tissue.uniform(name="damping x 1.5", viscous_n_mm_s_per_mm=1.5 * DAMPING),
            Tissue.uniform(name="damping x 0.5", viscous_n_mm_s_per_mm=0.5 * DAMPING),
            MATERIALS["soft-plastisol"],
            Tissue(
                name="deep layer 4 x",
                layers=(
                    Layer(interface=Interface(viscous_n_mm_s_per_mm=halves * DAMPING), fraction=0.5),
                    Layer(interface=Interface(viscous_n_mm_s_per_mm=4 * halves * DAMPING)),
                ),
            ),
            Tissue.uniform(
                name="dry friction", viscous_n_mm_s_per_mm=DAMPING, kinetic_n_mm_per_mm=0.006
            ),
        )
    }


ROBUST_CONTROLLERS = (
    "base_only",
    "feedforward",
    "adaptive",
    "feedback",
    "lqr",
    "least_time",
    "friction_aware",
)


def robustness(depth_cm: float = 10.0, free_mm: float = 50.0) -> list[StepResponse]:
    """The same step in tissue that the estimator does not model."""
    return [
        response
        for tissue in unmodelled_tissues().values()
        for response in compare(
            tissue, depth_cm=depth_cm, free_mm=free_mm, controllers=ROBUST_CONTROLLERS
        )
    ]


def as_row(response: StepResponse) -> dict[str, Any]:
    """The metrics in plain values, by the names of the CSV's columns."""
    return asdict(response) | {"worse_than_none": response.worse_than_none}
