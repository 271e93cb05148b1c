"""Step responses of several controllers on one rig, beside two baselines.

`base_only_at_limit` only turns the base, with the same motor limits as the controllers: the benefit of
a controller is its improvement on that. `base_only` is the paper's slow turn of the base, in
about 0.3 s, to which the paper's improvements refer.
"""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import pandas as pd

from models import published
from models.tissue import Tissue
from sim.closed_loop import ClosedLoopRun
from studies.control.step_response import (
    DESIGN,
    HOLD_S,
    ControlPlant,
    final_error_deg,
    largest_shear_stress_mpa,
    response_metrics,
    step_on,
)
from studies.control.tip_controllers import ControllerDesign

SLOW_BASELINE, SAME_LIMITS = "base_only", "base_only_at_limit"
_PUBLISHED = ("base_only", "feedforward", "feedback")
_WORST_OVERSHOOT_DEG = 10.0


@dataclass(frozen=True, kw_only=True)
class StepResponse:
    """Metrics of the step response of one controller on one rig.

    Attributes:
      plant: name of the rig.
      settle_s: NaN if the tip does not settle while the reference is held.
      settle_better, integral_better: improvement on base_only, %.
      published_settle_s, published_integral_deg_s: values of the paper, if it states them.
      shear_stress_mpa: largest shear stress in the shaft.
      final_error_deg: largest tip error of the last second.
      settle_better_same_limits, integral_better_same_limits: improvement on base_only_at_limit, %;
        NaN if that was not run.
    """

    tissue: str
    depth_cm: float
    free_mm: float
    controller: str
    settle_s: float
    integral_deg_s: float
    overshoot_deg: float
    largest_base_deg: float
    settle_better: float = 0.0
    integral_better: float = 0.0
    published_settle_s: float = math.nan
    published_integral_deg_s: float = math.nan
    plant: str = ""
    shear_stress_mpa: float = math.nan
    final_error_deg: float = math.nan
    settle_better_same_limits: float = math.nan
    integral_better_same_limits: float = math.nan

    @property
    def worse_than_none(self) -> bool:
        """Whether the response is worse than with the base alone."""
        slower = self.settle_better < 0 or self.integral_better < 0
        return self.controller != SLOW_BASELINE and (slower or self.overshoot_deg > _WORST_OVERSHOOT_DEG)

    @property
    def failures(self) -> tuple[str, ...]:
        """What failed, in words; empty if the tip settled sooner than with the base alone."""
        compared = self.controller not in (SLOW_BASELINE, SAME_LIMITS)
        found = {
            f"never settles, final error {self.final_error_deg:.1f} deg": math.isnan(self.settle_s),
            f"overshoots by {self.overshoot_deg:.0f} deg": self.overshoot_deg > _WORST_OVERSHOOT_DEG,
            "settles later than the base alone": compared
            and not math.isnan(self.settle_s)
            and self.settle_better_same_limits < 0,
            "more error than the base alone": compared and self.integral_better_same_limits < 0,
        }
        return tuple(words for words, happened in found.items() if happened)


def compare_on(
    plant: ControlPlant,
    *,
    depth_cm: float,
    free_mm: float,
    controllers: tuple[str, ...],
    hold_s: float = HOLD_S,
) -> list[StepResponse]:
    """Every controller on one rig; improvements are relative to the baselines among them.

    Args:
      hold_s: how long the reference is held; a tip that does not settle within it never does.
    """
    responses = []
    for name in controllers:
        made = step_on(plant, name, depth_cm=depth_cm, free_mm=free_mm, hold_s=hold_s)
        responses.append(_measured(plant, name, depth_cm, free_mm, made))
    slow = _of(SLOW_BASELINE, responses) or responses[0]
    same_limits = _of(SAME_LIMITS, responses)
    return [_compared(response, slow, same_limits) for response in responses]


def compare(
    tissue: Tissue,
    *,
    depth_cm: float,
    free_mm: float,
    controllers: tuple[str, ...],
    design: ControllerDesign = DESIGN,
    hold_s: float = HOLD_S,
) -> list[StepResponse]:
    """Every controller in one tissue, with ideal hardware."""
    plant = ControlPlant(name=tissue.name, tissue=tissue, needle=design.needle, design=design)
    return compare_on(plant, depth_cm=depth_cm, free_mm=free_mm, controllers=controllers, hold_s=hold_s)


def _measured(
    plant: ControlPlant, controller: str, depth_cm: float, free_mm: float, made: ClosedLoopRun
) -> StepResponse:
    settle, integral, overshoot, base = response_metrics(made.run)
    return StepResponse(
        tissue=plant.tissue.name,
        depth_cm=depth_cm,
        free_mm=free_mm,
        controller=controller,
        settle_s=settle,
        integral_deg_s=integral,
        overshoot_deg=overshoot,
        largest_base_deg=base,
        published_settle_s=_printed(plant, published.TABLE_IV_SETTLE_S, depth_cm, controller),
        published_integral_deg_s=_printed(plant, published.TABLE_V_INTEGRAL_DEG_S, depth_cm, controller),
        plant=plant.name,
        shear_stress_mpa=largest_shear_stress_mpa(made.run),
        final_error_deg=final_error_deg(made.run),
    )


def _of(controller: str, responses: list[StepResponse]) -> StepResponse | None:
    return next((r for r in responses if r.controller == controller), None)


def _compared(
    response: StepResponse, slow: StepResponse, same_limits: StepResponse | None
) -> StepResponse:
    compared = replace(
        response,
        settle_better=better_percent(response.settle_s, slow.settle_s),
        integral_better=better_percent(response.integral_deg_s, slow.integral_deg_s),
    )
    if same_limits is None:
        return compared
    return replace(
        compared,
        settle_better_same_limits=better_percent(response.settle_s, same_limits.settle_s),
        integral_better_same_limits=better_percent(response.integral_deg_s, same_limits.integral_deg_s),
    )


def better_percent(value: float, baseline: float) -> float:
    """Improvement, %: 100 if only the baseline never settles, -100 if only this one."""
    if math.isnan(baseline):
        return 0.0 if math.isnan(value) else 100.0
    return -100.0 if math.isnan(value) else 100.0 * (1.0 - value / baseline)


def _printed(plant: ControlPlant, table: Any, depth_cm: float, controller: str) -> float:
    paper_rig = plant.name == "viscous-plastisol"
    if not paper_rig or controller not in _PUBLISHED or depth_cm not in table:
        return math.nan
    return float(table[depth_cm][_PUBLISHED.index(controller)])


def as_row(response: StepResponse) -> dict[str, Any]:
    """The metrics as plain values, by the column names of the CSV."""
    failed = {"failed": "; ".join(response.failures)}
    return asdict(response) | {"worse_than_none": response.worse_than_none} | failed


def response_table(responses: Sequence[StepResponse]) -> pd.DataFrame:
    """The metrics as a table, one row per response."""
    return pd.DataFrame([as_row(response) for response in responses])
