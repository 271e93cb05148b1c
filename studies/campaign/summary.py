"""Summary of a campaign: statistics of every result, and its correlation with what varies."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from scipy.stats import spearmanr

from models.errors import InvalidValue
from sim.files import write_text, writing
from studies.campaign.campaign import Campaign
from studies.campaign.columns import DONE, RESULTS
from studies.campaign.posterior import bands
from studies.campaign.results import ResultFolder

_QUANTILES = {"p2.5": 0.025, "p25": 0.25, "median": 0.5, "p75": 0.75, "p97.5": 0.975}
_LEAST_POINTS = 3  # of a rank correlation
_LINE_UP_TO = 12  # different values, beyond which points are a cloud
_WIDTH, _HEIGHT = 3.2, 2.6  # of a picture's panel, inches


def summarise(results: ResultFolder) -> list[Path]:
    """Write `summary.csv` and `summary.png`, and for a posterior `bands.csv` and `bands.png`; returns
    their paths."""
    table = results.read()
    csv, png = results.folder / "summary.csv", results.folder / "summary.png"
    write_text(csv, summary_table(results, table).to_csv(float_format="%.6g"), force=True)
    with writing(png, force=True) as part:
        draw(results, table, part)
    return [csv, png, *(_write_bands(results, table) if results.campaign.posterior else ())]


def _write_bands(results: ResultFolder, table: pd.DataFrame) -> list[Path]:
    csv, png = results.folder / "bands.csv", results.folder / "bands.png"
    found = tip_error_bands(results.campaign, table)
    write_text(csv, found.to_csv(index=False, float_format="%.6g"), force=True)
    rigs = int((table["status"] == DONE).sum())
    with writing(png, force=True) as part:
        bands.draw(found, f"{results.campaign.name}: tip error of {rigs} rigs", part)
    return [csv, png]


def tip_error_bands(campaign: Campaign, table: pd.DataFrame) -> pd.DataFrame:
    """Bands of the tip error, for a campaign over a posterior: see `bands.bands`."""
    if campaign.posterior is None or campaign.base is None:
        raise InvalidValue("kind", campaign.kind.value, "posterior")
    errors = table["tip_error_deg"][table["status"] == DONE]
    return bands.bands(campaign.posterior, campaign.base, np.array(errors.tolist(), float))


def summary_table(results: ResultFolder, table: pd.DataFrame) -> pd.DataFrame:
    """By numeric result: count, mean, standard deviation, extremes, quantiles, and the rank correlation
    (Spearman) with each value that varies, NaN where one of the two does not."""
    done = table[table["status"] == DONE]
    rows = {name: _row(done, name, numeric_varied(results, done)) for name in _numeric(results)}
    found = pd.DataFrame.from_dict(rows, orient="index")
    found.index.name = "result"
    return found


def _row(done: pd.DataFrame, name: str, varied: list[str]) -> dict[str, float]:
    values = done[name].dropna()
    row: dict[str, float] = {
        "cases": values.size,
        "mean": values.mean(),
        "sd": values.std(),
        "min": values.min(),
        **{label: float(values.quantile(q)) for label, q in _QUANTILES.items()},
        "max": values.max(),
    }
    return row | {f"rank correlation with {path}": _rank(done, path, name) for path in varied}


def _rank(done: pd.DataFrame, path: str, name: str) -> float:
    both = done[[path, name]].dropna()
    if len(both) < _LEAST_POINTS or both.nunique().min() < 2:
        return float("nan")
    return float(spearmanr(both[path], both[name]).statistic)


def _numeric(results: ResultFolder) -> list[str]:
    kinds = RESULTS[results.campaign.kind]
    return [name for name, kind in kinds.items() if str(kind) in ("double", "int64")]


def numeric_varied(results: ResultFolder, table: pd.DataFrame) -> list[str]:
    """Paths of what varies and is a number."""
    return [path for path in results.campaign.varied if pd.api.types.is_float_dtype(table[path])]


def draw(results: ResultFolder, table: pd.DataFrame, path: Path) -> None:
    """Draw each result over each varied value; if none varies, its distribution."""
    done = table[table["status"] == DONE]
    across = list(results.campaign.varied) or [""]
    down = [name for name in _numeric(results) if done[name].nunique() > 1] or _numeric(results)[:1]
    size = (max(2, len(across)) * _WIDTH, len(down) * _HEIGHT)
    figure, axes = plt.subplots(
        len(down), len(across), figsize=size, squeeze=False, layout="constrained"
    )
    for row, name in zip(axes, down, strict=True):
        for axis, varied in zip(row, across, strict=True):
            _panel(axis, done, varied, name)
            axis.set_ylabel(name, fontsize=7, parse_math=False)
    failed = int((table["status"] != DONE).sum())
    title = f"{results.campaign.name}: {len(done)} cases, {failed} failed"
    figure.suptitle(title, parse_math=False)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _panel(axis: Axes, done: pd.DataFrame, varied: str, name: str) -> None:
    axis.tick_params(labelsize=6)
    both = done[[varied, name]].dropna() if varied else done[[name]].dropna()
    if not varied:
        axis.hist(both[name], bins="auto", orientation="horizontal", color="C0")
        axis.set_xlabel("cases", fontsize=7)
        return
    axis.set_xlabel(varied, fontsize=7, parse_math=False)
    if pd.api.types.is_numeric_dtype(both[varied]):
        axis.set_title(f"rank correlation {_rank(done, varied, name):.2f}", fontsize=6)
    axis.plot(both[varied], both[name], ".", markersize=3, color="C0", alpha=0.5)
    if both[varied].nunique() <= _LINE_UP_TO:
        middle = both.groupby(varied)[name].median()
        axis.plot(np.asarray(middle.index), middle, "-", color="C1", linewidth=1)
