"""Bands of the tip error over time: the uncertainty that a diagnosis leaves, at the tip.

The lines of the band are the 5, 50 and 95 % quantiles of the tip errors of the drawn rigs at each time.
The tip errors of the nominal rig (before the diagnosis) and of the most probable one are added.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from numpy.typing import NDArray

from models.errors import NeedleError
from sim.batch import simulate_each
from sim.protocol import Protocol
from studies.campaign.posterior.drawn_rig import drawn_rig, times_s, tip_error_deg
from studies.campaign.posterior.rig_posterior import RigPosterior

Array = NDArray[np.float64]

QUANTILES = {"p5_deg": 0.05, "p50_deg": 0.5, "p95_deg": 0.95}


def bands(posterior: RigPosterior, motion: Protocol, errors_deg: Array) -> pd.DataFrame:
    """Columns `time_s`, `base_angle_deg` as the protocol asks, and tip errors: `nominal_deg` of the
    nominal rig, `fit_deg` of the most probable one, and the quantiles.

    Args:
      errors_deg: tip errors of the drawn rigs, (rigs, times); without rigs, quantiles are NaN.
    """
    known = [drawn_rig(posterior, motion, values) for values in ({}, posterior.fitted)]
    at = times_s(motion)
    table = pd.DataFrame({"time_s": at, "base_angle_deg": known[0].wanted_deg(at)})
    runs = simulate_each(known, threads=1)
    for name, drawn, run in zip(("nominal_deg", "fit_deg"), known, runs, strict=True):
        table[name] = np.nan if isinstance(run, NeedleError) else tip_error_deg(drawn, run)
    for name, share in QUANTILES.items():
        table[name] = np.quantile(errors_deg, share, axis=0) if len(errors_deg) else np.nan
    return table


def draw(table: pd.DataFrame, title: str, path: Path) -> None:
    """Draw the base angle of the protocol, the tip errors, and their distance from the median."""
    figure, (asked, error, spread) = plt.subplots(
        3, 1, figsize=(7.5, 7.5), sharex=True, height_ratios=(1, 2.5, 1.2), layout="constrained"
    )
    time = table["time_s"]
    asked.plot(time, table["base_angle_deg"], color="0.3")
    asked.set_ylabel("base, deg")
    _draw_errors(error, table)
    low, middle, high = (table[name] for name in QUANTILES)
    spread.fill_between(time, low - middle, high - middle, color="C0", alpha=0.4)
    spread.set(xlabel="time, s", ylabel="90 of 100 rigs,\nfrom the median, deg")
    figure.suptitle(title, parse_math=False)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _draw_errors(axis: Axes, table: pd.DataFrame) -> None:
    time = table["time_s"]
    label = "90 of 100 rigs"
    axis.fill_between(time, table["p5_deg"], table["p95_deg"], color="C0", alpha=0.4, label=label)
    axis.plot(time, table["p50_deg"], color="C0", label="median")
    axis.plot(time, table["fit_deg"], "--", color="C1", label="most probable rig")
    axis.plot(time, table["nominal_deg"], ":", color="k", label="nominal rig")
    axis.axhline(0.0, color="0.85", zorder=0)
    axis.set_ylabel("tip error (base minus tip), deg")
    axis.legend(fontsize=8)
