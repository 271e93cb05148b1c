"""Step responses as tables of at most 80 columns: settling, integral, robustness, what failed."""

import math
from collections.abc import Iterable

from rich import box
from rich.table import Table

from studies.control.comparison import SAME_LIMITS, SLOW_BASELINE, StepResponse

_GROUPS = {
    "compensators": (SAME_LIMITS, "feedforward", "adaptive", "friction_aware"),
    "regulators and plans": ("lqr", "predictive", "least_time"),
    "torque bias estimated": ("unbiased", "bias_tracking", "predictive_unbiased"),
    "with a tip sensor": ("feedback", "predictive_feedback", "friction_aware_feedback"),
}


_BASELINES = (
    "Same limits: the base alone, as fast as the motor can. Base only: in 0.3 s, as in the paper."
)


def settling_table(responses: list[StepResponse]) -> Table:
    """Table IV: settling to 3 deg."""
    table = _table("Table IV: a step of 90 deg, time to settle within 3 deg, s")
    table.caption = _BASELINES
    for o in responses:
        table.add_row(
            *_where(o),
            _settling(o),
            *_paper(o.settle_s, o.published_settle_s, ".2f"),
            _percent(o.settle_better_same_limits),
            _percent(o.settle_better),
            end_section=o is responses[-1] or _next_differs(responses, o),
        )
    return table


def integral_table(responses: list[StepResponse]) -> Table:
    """Table V: the integral of tip error over 2 s; and the largest shear stress."""
    table = _table("Table V: a step of 90 deg, integral of the tip error over 2 s, deg s")
    table.add_column("MPa", justify="right")
    for o in responses:
        table.add_row(
            *_where(o),
            f"{o.integral_deg_s:.1f}",
            *_paper(o.integral_deg_s, o.published_integral_deg_s, ".1f"),
            _percent(o.integral_better_same_limits),
            _percent(o.integral_better),
            f"{o.shear_stress_mpa:.0f}",
            end_section=o is responses[-1] or _next_differs(responses, o),
        )
    table.caption = f"{_BASELINES}\nMPa: largest shear stress in the shaft."
    return table


def robustness_tables(responses: list[StepResponse]) -> list[Table]:
    """Settling on every rig, one table per group of controllers."""
    rigs = list(dict.fromkeys(o.plant for o in responses))
    found = {(o.plant, o.controller): o for o in responses}
    tables = []
    for title, controllers in _GROUPS.items():
        table = Table(
            title=f"Robustness, {title}: time to settle, s", box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0)
        )
        table.add_column("rig", width=21)
        for name in controllers:
            table.add_column(name.replace("_", " "), justify="right", width=12)
        for rig in rigs:
            cells = {name: found.get((rig, name)) for name in controllers}
            if any(o for name, o in cells.items() if name != SAME_LIMITS):
                table.add_row(rig, *(_cell(o) if o else "" for o in cells.values()))
        table.caption = "^: overshoot, deg, if beyond 3. never: does not settle; remaining error, deg"
        tables.append(table)
    return tables


def failures_table(responses: Iterable[StepResponse]) -> Table:
    """All failures, except those of the baselines."""
    table = Table(title="What failed", box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("rig", max_width=28)
    table.add_column("controller", no_wrap=True)
    table.add_column("how", max_width=30)
    for o in responses:
        if o.failures and o.controller not in (SAME_LIMITS, SLOW_BASELINE):
            table.add_row(o.plant, o.controller, "; ".join(o.failures))
    return table


def _table(title: str) -> Table:
    table = Table(title=title, box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("deep\ncm", justify="right")
    table.add_column("free\nmm", justify="right")
    table.add_column("controller", no_wrap=True)
    for heading in ("ours", "paper", "ratio", "better than same limits", "better than base only"):
        table.add_column(heading, justify="right", max_width=11)
    return table


def _next_differs(responses: list[StepResponse], o: StepResponse) -> bool:
    following = responses[responses.index(o) + 1]
    return (following.depth_cm, following.free_mm) != (o.depth_cm, o.free_mm)


def _where(o: StepResponse) -> tuple[str, str, str]:
    return f"{o.depth_cm:g}", f"{o.free_mm:g}", o.controller


def _settling(o: StepResponse) -> str:
    return "never" if math.isnan(o.settle_s) else f"{o.settle_s:.2f}"


def _cell(o: StepResponse) -> str:
    if math.isnan(o.settle_s):
        return f"never {o.final_error_deg:.1f}"
    return _settling(o) + (f" ^{o.overshoot_deg:.0f}" if o.overshoot_deg > 3 else "")


def _paper(value: float, published: float, shape: str) -> tuple[str, str]:
    if math.isnan(published):
        return "", ""
    return format(published, shape), f"{value / published:.2f}"


def _percent(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.0f} %"
