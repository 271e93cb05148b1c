"""Detection limits beside something that the rig has: a peak torque, a stiffness, a turn, a length."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import PREDICTIONS, WIDE
from diagnosis.result import Diagnosis


@dataclass(frozen=True, kw_only=True)
class LimitShare:
    """A detection limit as a share of something that the rig has.

    Attributes:
      share_percent: of `reference`; infinite: any strength may go unseen.
      reference: in words.
    """

    effect: str
    share_percent: float
    reference: str


def limit_shares(found: Diagnosis) -> list[LimitShare]:
    """Detection limits, the smallest share first."""
    references = _references(found)
    shares = [
        _share(name, limit.parameters, references)
        for name, limit in found.assessment.detection_limits.items()
    ]
    return sorted(shares, key=lambda one: one.share_percent)


def draw_limits(found: Diagnosis) -> Figure:
    """A bar for each effect, as long as what may go unseen."""
    shares = [one for one in limit_shares(found) if math.isfinite(one.share_percent)]
    figure, axis = subplots(figsize=(WIDE, 1.0 + 0.27 * len(shares)))
    rows, percent = np.arange(len(shares)), np.array([one.share_percent for one in shares])
    lowest = 10.0 ** math.floor(math.log10(max(percent.min(initial=1.0), 1e-6)))
    axis.barh(rows, percent - lowest, left=lowest, color=PREDICTIONS["nominal"], height=0.6)
    for row, one in enumerate(shares):
        axis.text(
            1.1 * one.share_percent,
            row,
            f"{one.share_percent:.2g} % of {one.reference}",
            va="center",
            fontsize=8,
        )
    axis.set_yticks(rows, [one.effect for one in shares], fontsize=9)
    axis.invert_yaxis()
    axis.set(xscale="log", xlim=(lowest, max(percent.max(initial=1.0), 1.0) * 300))
    axis.minorticks_off()  # they take half of the time
    axis.set_xlabel("may be present and go unseen, %")
    return figure


def describe_limits(found: Diagnosis) -> str:
    """The picture in words."""
    shares = limit_shares(found)
    told = "; ".join(
        f"{one.effect} {one.share_percent:.2g} % of {one.reference}"
        if math.isfinite(one.share_percent)
        else f"{one.effect} any strength"
        for one in shares
    )
    return f"Bars on a logarithmic axis: what of each effect may be present and go unseen. {told}."


def _share(
    name: str, values: Mapping[str, float], references: Mapping[str, tuple[float, str]]
) -> LimitShare:
    """Of the parameter of an effect that says most of its strength."""
    own = {p.name: p for p in LIBRARY[name].parameters if p.neutral is not None}
    each = [(_percent(own[p], v, references), own[p].unit) for p, v in values.items() if p in own]
    if not each:
        return LimitShare(effect=name, share_percent=math.inf, reference="")
    percent, unit = max(each)
    return LimitShare(effect=name, share_percent=percent, reference=references[unit][1])


def _percent(parameter: Parameter, value: float, references: Mapping[str, tuple[float, str]]) -> float:
    """Strength over that of what the rig has; a spring counts by its compliance."""
    reference, strength = references[parameter.unit][0], parameter.distance_from_neutral(value)
    if parameter.neutral == math.inf:
        return 100.0 * strength * reference
    return 100.0 * strength / reference


def _references(found: Diagnosis) -> dict[str, tuple[float, str]]:
    """What the rig has, by unit of the parameters, and its name."""
    rig, trials = found.log.rig, found.log.trials
    inserted = max(float(np.nanmax(t["inserted_mm"])) for t in trials)
    free = float(np.nanmedian(np.concatenate([t["free_mm"] for t in trials])))
    turn = max(float(np.nanmax(t["base_angle_deg"]) - np.nanmin(t["base_angle_deg"])) for t in trials)
    torque = max(float(np.max(np.abs(p["base_torque_n_mm"]))) for p in found.assessment.explained)
    stiffness = rig.rigidity_n_mm2 / (free + inserted)
    damping = rig.tissue.damping_n_mm_s_per_mm * inserted
    return {
        "-": (1.0, "its nominal value"),
        "deg": (turn, f"the largest turn, {turn:.0f} deg"),
        "mm": (inserted, f"the inserted length, {inserted:.0f} mm"),
        "s": (
            damping / stiffness,
            f"damping over stiffness of the shaft, {damping / stiffness:.2g} s",
        ),
        "N mm": (torque, f"the peak torque, {torque:.2g} N mm"),
        "N mm / mm": (torque / inserted, f"the peak torque, {torque:.2g} N mm over {inserted:.0f} mm"),
        "N mm s / rad": (damping, f"the damping of the inserted shaft, {damping:.2g} N mm s / rad"),
        "N mm / rad": (stiffness, f"the compliance of the shaft, 1 / {stiffness:.2g} rad / N mm"),
        "N mm / rad / mm": (
            stiffness / inserted,
            f"the compliance of the shaft, 1 / {stiffness:.2g} rad / N mm",
        ),
    }
