"""The score as a picture: what was said of what, how sure, how much is left, how small is seen."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from validation.score.detection import limits, of_one_effect
from validation.score.calibration import GAP_GOAL, calibration_error, coverage, gap_left, reliability


def draw(scores: pd.DataFrame, path: Path) -> None:
    """Confusion, reliability, detection of each effect, and the gap that is left."""
    figure, axes = plt.subplots(2, 2, figsize=(15, 13), layout="constrained", width_ratios=(2, 1))
    _confusion(axes[0, 0], scores)
    _reliability(axes[0, 1], scores)
    _detection(axes[1, 0], scores)
    _left(axes[1, 1], scores)
    figure.savefig(path, dpi=80, format="png")
    plt.close(figure)


def _confusion(axis: Axes, scores: pd.DataFrame) -> None:
    """Rows: what was so; columns: what was said. Pairs are told as right or not."""
    one = scores[scores["kind"] != "pair"]
    said = one["said"].mask(one["verdict"] == "undecided", "undecided").mask(one["exact"], one["truth"])
    one = one.assign(said=said)
    table = pd.crosstab(one["truth"], one["said"])
    names = [*table.index, *(c for c in table.columns if c not in table.index)]
    table = table.reindex(columns=names, fill_value=0)
    axis.imshow(np.log1p(table.to_numpy()), cmap="Blues", aspect="auto")
    for (i, j), count in np.ndenumerate(table.to_numpy()):
        if count:
            axis.text(j, i, str(count), ha="center", va="center", fontsize=8)
    axis.set_yticks(range(len(table.index)), list(table.index), fontsize=8)
    axis.set_xticks(range(len(names)), names, fontsize=8, rotation=60, ha="right")
    axis.set(title="one effect, none and outside: what was so against what was said")


def _reliability(axis: Axes, scores: pd.DataFrame) -> None:
    table = reliability(scores)
    axis.plot([0, 1], [0, 1], color="0.7")
    axis.plot(table["said"], table["was"], "o-", color="tab:red")
    for _, row in table.iterrows():
        axis.annotate(f"{row['logs']:.0f}", (row["said"], row["was"]), fontsize=8)
    share, count = coverage(scores)
    axis.set(
        xlabel="probability that was given",
        ylabel="share that was right",
        title=f"off by {calibration_error(scores):.3f}; {100 * share:.1f} % of {count} intervals cover",
    )


def _detection(axis: Axes, scores: pd.DataFrame) -> None:
    """Every log of one effect at its signature, and where it starts to be named."""
    one = of_one_effect(scores)
    if one.empty:
        axis.set(title="no log of one effect whose signature is known", xticks=[], yticks=[])
        return
    found, effects = limits(one), sorted(one["truth"].unique(), reverse=True)
    rows = {effect: row for row, effect in enumerate(effects)}
    wrong = (one["verdict"] == "explained") & ~one["exact"]
    groups = {
        "exact": (one["exact"], "tab:blue", "o"),
        "not named": (~one["exact"] & ~wrong, "0.6", "x"),
        "explained wrongly": (wrong, "tab:red", "s"),
    }
    for label, (chosen, colour, marker) in groups.items():
        own, shown = one[chosen], f"{label}: {chosen.sum()}"
        at = own["signature"], own["truth"].map(rows)
        axis.scatter(*at, c=colour, marker=marker, s=25, label=shown)
    limit = found["limit"].dropna()
    axis.scatter(limit, limit.index.map(rows), c="k", marker="|", s=200, label="detection limit")
    axis.set_yticks(range(len(effects)), effects, fontsize=8)
    axis.set(
        xscale="log", xlabel="signature of the effect, over noise", title="how small an effect is named"
    )
    axis.legend(fontsize=8, ncols=4, loc="upper center", bbox_to_anchor=(0.5, -0.1))


def _left(axis: Axes, scores: pd.DataFrame) -> None:
    right = scores[(scores["expected"] == "explained") & scores["exact"]]
    axis.hist(np.clip(right["gap_after"], 0.9, 1.15), bins=26, range=(0.9, 1.15), color="tab:blue")
    axis.axvline(GAP_GOAL, color="k", lw=1)
    axis.set(
        xlabel="gap left over noise, held out",
        ylabel="logs",
        title=f"{100 * gap_left(scores):.1f} % within {GAP_GOAL}",
    )
