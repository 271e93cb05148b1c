"""The score as a figure: true vs diagnosed, reliability, detection limits, and the remaining gap.

    python -m validation.score.picture docs/blind_scores.csv docs/images/blind_score.png

draws it from a scores.csv of `needle blind score`.
"""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from validation.logs.schedule import EFFECTS_OF_KIND
from validation.score.calibration import (
    GAP_GOAL,
    calibration_error,
    confidently_wrong,
    coverage,
    gap_left,
    reliability,
)
from validation.score.detection import detection_limits, of_one_effect

PALEST = 1.8
"""Ends of the scale of a colour map over its largest count: so that black is read on every cell."""


def draw(scores: pd.DataFrame, path: Path) -> None:
    """Write the figure as a PNG; `scores` as `read_scores` returns them."""
    figure, axes = plt.subplots(2, 2, figsize=(15, 13), layout="constrained", width_ratios=(2, 1))
    wrong = int(confidently_wrong(scores).sum())
    figure.suptitle(f"Confidently wrong (explained or none, but wrong): {wrong} of {len(scores)} logs")
    _confusion(axes[0, 0], scores)
    _reliability(axes[0, 1], scores)
    _detection(axes[1, 0], scores)
    _gap_left(axes[1, 1], scores)
    figure.savefig(path, dpi=80, format="png", facecolor="white")
    plt.close(figure)


def _confusion(axis: Axes, scores: pd.DataFrame) -> None:
    """Draw true (rows) vs diagnosed (columns); logs with several effects are left out."""
    one = scores[~scores["kind"].isin(EFFECTS_OF_KIND)]
    if one.empty:
        axis.set(title="True vs diagnosed: all logs have several effects", xticks=[], yticks=[])
        return
    said = one["said"].mask(one["verdict"] == "undecided", "undecided").mask(one["exact"], one["truth"])
    table = pd.crosstab(one["truth"], said.rename("said"))
    names = [*table.index, *(c for c in table.columns if c not in table.index)]
    counts = table.reindex(columns=names, fill_value=0).to_numpy()
    shades = np.log1p(counts)
    axis.imshow(shades, cmap="Blues", vmin=0.0, vmax=PALEST * shades.max(), aspect="auto")
    for (i, j), count in np.ndenumerate(counts):
        if count:
            axis.text(j, i, str(count), ha="center", va="center", fontsize=9)
    axis.set_yticks(range(len(table.index)), list(table.index), fontsize=9)
    axis.set_xticks(range(len(names)), names, fontsize=9, rotation=60, ha="right")
    axis.set(
        title="True vs diagnosed, number of logs (several effects left out)",
        xlabel="diagnosed",
        ylabel="true",
    )


def _reliability(axis: Axes, scores: pd.DataFrame) -> None:
    table = reliability(scores)
    axis.plot([0, 1], [0, 1], color="0.6", ls="--", label="perfectly calibrated")
    axis.plot(table["predicted"], table["observed"], "o-", color="tab:red", label="measured")
    for _, row in table.iterrows():
        axis.annotate(
            f"{row['logs']:.0f} log{'' if row['logs'] == 1 else 's'}",
            (row["predicted"], row["observed"]),
            xytext=(-6, -12),
            textcoords="offset points",
            ha="right",
            fontsize=9,
        )
    share, count = coverage(scores)
    axis.set(
        xlabel="stated probability of the first explanation in the ranking",
        ylabel="share of logs in which it is true",
        xlim=(-0.05, 1.05),
        ylim=(-0.05, 1.05),
        title=f"Reliability: calibration error {calibration_error(scores):.3f}\n"
        f"{100 * share:.1f} % of {count} intervals (95 %) contain the truth",
    )
    axis.legend(fontsize=9, loc="upper left")


def _detection(axis: Axes, scores: pd.DataFrame) -> None:
    """Draw every log of one effect at its signature, and the detection limits."""
    one = of_one_effect(scores)
    if one.empty:
        axis.set(title="Detection: no log of one effect of known signature", xticks=[], yticks=[])
        return
    effects = sorted(one["truth"].unique(), reverse=True)
    rows = {effect: row for row, effect in enumerate(effects)}
    wrong = confidently_wrong(one)
    groups = {
        "exact": (one["exact"], "tab:blue", "o"),
        "not named": (~one["exact"] & ~wrong, "0.5", "x"),
        "confidently wrong": (wrong, "tab:red", "s"),
    }
    for label, (chosen, colour, marker) in groups.items():
        own = one[chosen]
        at = own["signature"], own["truth"].map(rows)
        axis.scatter(*at, c=colour, marker=marker, s=25, label=f"{label}: {chosen.sum()}")
    limit = detection_limits(one)["limit"].dropna()
    axis.scatter(limit, limit.index.map(rows), c="k", marker="|", s=200, label="detection limit")
    axis.set_yticks(range(len(effects)), effects, fontsize=9)
    axis.set(
        xscale="log",
        xlabel="signature: rms of what the effect changes / σ (σ = sensor noise)",
        title="Detection: which logs of one effect are named",
    )
    axis.legend(fontsize=9, ncols=4, loc="upper center", bbox_to_anchor=(0.5, -0.1))


def _gap_left(axis: Axes, scores: pd.DataFrame) -> None:
    right = scores[(scores["expected"] == "explained") & scores["exact"]]
    axis.hist(
        np.clip(right["gap_after"], 0.9, 1.15), bins=26, range=(0.9, 1.15), color="tab:blue", alpha=0.6
    )
    axis.axvline(GAP_GOAL, color="k", lw=2, ls="--", label=f"{GAP_GOAL} σ")
    axis.set(
        xlabel="rms residual / σ after the diagnosis, held-out data",
        ylabel="logs",
        title=f"Gap left: {100 * gap_left(scores):.1f} % of the exact\ndiagnoses within {GAP_GOAL} σ",
    )
    axis.yaxis.set_major_locator(MaxNLocator(integer=True))
    axis.legend(fontsize=9)


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="draw the score from a scores.csv")
    parser.add_argument("csv", type=Path, help="scores.csv of needle blind score")
    parser.add_argument("png", type=Path, help="the figure; replaced if it exists")
    given = parser.parse_args()
    draw(pd.read_csv(given.csv, index_col="case"), given.png)


if __name__ == "__main__":
    main()
