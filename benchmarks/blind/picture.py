"""The score as a picture: what was said of what, how sure, how much is left, how small is seen."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from benchmarks.blind.score import GAP_GOAL, calibration_error, coverage, gap_left, reliability

_BINS = (0.1, 0.2, 0.35, 0.6, 1.0, 1.7, 3.0, 6.0, 12.0, 40.0)


def draw(scores: pd.DataFrame, path: Path) -> None:
    """Confusion, reliability, exactness against signature, and the gap that is left."""
    figure, axes = plt.subplots(2, 2, figsize=(15, 13), layout="constrained", width_ratios=(2, 1))
    _confusion(axes[0, 0], scores)
    _reliability(axes[0, 1], scores)
    _detection(axes[1, 0], scores)
    _left(axes[1, 1], scores)
    figure.savefig(path, dpi=80, format="png")
    plt.close(figure)


def _confusion(axis: Axes, scores: pd.DataFrame) -> None:
    """Rows: what was so; columns: what was said. Pairs are told as right or not."""
    one = scores[scores["kind"] != "pair"].assign(
        said=lambda s: np.where(s["exact"], s["truth"], s["said"]),
    )
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
    found = scores[scores["signature"].notna() & (scores["expected"] == "explained")]
    groups = found.groupby(np.digitize(found["signature"], _BINS))
    middle = groups["signature"].median()
    axis.semilogx(middle, groups["exact"].mean(), "o-", color="tab:blue", label="exact")
    wrong = groups.apply(lambda g: float(((g["verdict"] == "explained") & ~g["exact"]).mean()))
    axis.semilogx(middle, wrong, "o-", color="tab:red", label="explained wrongly")
    for x, y, size in zip(middle, groups["exact"].mean(), groups.size(), strict=True):
        axis.annotate(str(size), (x, y), fontsize=8)
    axis.set(
        xlabel="signature of the weaker effect, over noise", ylabel="share of logs", ylim=(-0.05, 1.05)
    )
    axis.legend(fontsize=8)


def _left(axis: Axes, scores: pd.DataFrame) -> None:
    right = scores[(scores["expected"] == "explained") & scores["exact"]]
    axis.hist(np.clip(right["gap_after"], 0.9, 1.15), bins=26, range=(0.9, 1.15), color="tab:blue")
    axis.axvline(GAP_GOAL, color="k", lw=1)
    axis.set(
        xlabel="gap left over noise, held out",
        ylabel="logs",
        title=f"{100 * gap_left(scores):.1f} % within {GAP_GOAL}",
    )
