"""Accuracy and calibration over many logs: share of exact reports, reliability of probabilities."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

GAP_GOAL = 1.03
"""Residual / sigma that an exact diagnosis should leave at most."""
_BINS = 5  # of probability


def summary(scores: pd.DataFrame) -> pd.DataFrame:
    """By kind: numbers of logs and of confidently wrong ones, shares, median and longest time, s."""
    grouped = scores.groupby("kind")
    return pd.DataFrame(
        {
            "logs": grouped.size(),
            "confidently_wrong": confidently_wrong(scores).groupby(scores["kind"]).sum(),
            "exact": grouped["exact"].mean(),
            "undecided": grouped["verdict"].apply(lambda v: float((v == "undecided").mean())),
            "unknown": grouped["verdict"].apply(lambda v: float((v == "unknown").mean())),
            "seconds": grouped["seconds"].median(),
            "worst_seconds": grouped["seconds"].max(),
        }
    )


def confidently_wrong(scores: pd.DataFrame) -> "pd.Series[bool]":
    """Per log; for tables without that column: `explained` or `none`, and not exact."""
    if "confidently_wrong" in scores:
        return scores["confidently_wrong"].astype(bool)
    return scores["verdict"].isin(["explained", "none"]) & ~scores["exact"].astype(bool)


def coverage(scores: pd.DataFrame) -> tuple[float, int]:
    """Share of the 95 % intervals that contain the true value, and their number."""
    count = int(scores["intervals"].sum())
    return (float(scores["inside"].sum() / count) if count else float("nan")), count


def undetected_within_limit(scores: pd.DataFrame) -> tuple[float, int]:
    """Share of the undetected effects at or below the reported detection limit, and their number."""
    ratio = scores.loc[scores["verdict"] == "none", "over_hidden"].dropna()
    return (float((ratio <= 1.0).mean()) if len(ratio) else float("nan")), len(ratio)


def reliability(scores: pd.DataFrame) -> pd.DataFrame:
    """By bin of probability: predicted and observed share of right first ranks, and number of logs.

    If several effects are true, the predicted share is the probability of all of them together.
    """
    scores = scores[scores["probability"].notna()]
    share = _predicted(scores)
    table = pd.DataFrame(
        {
            "bin": _bins(share),
            "predicted": share,
            "observed": scores["top_right"].astype(float),
        }
    )
    grouped = table.groupby("bin")
    return pd.DataFrame(
        {
            "predicted": grouped["predicted"].mean(),
            "observed": grouped["observed"].mean(),
            "logs": grouped.size(),
        }
    )


def calibration_error(scores: pd.DataFrame) -> float:
    """Expected calibration error: mean |predicted - observed|, weighted by logs."""
    table = reliability(scores)
    distance = (table["predicted"] - table["observed"]).abs()
    return float((table["logs"] * distance).sum() / table["logs"].sum())


def calibration_error_by_chance(scores: pd.DataFrame) -> float:
    """What the calibration error would be if every probability were right: so few logs tell no better.

    The mean of 2000 draws, in which each first rank is right with the probability that was predicted.
    """
    share = _predicted(scores[scores["probability"].notna()])
    if not share.size:
        return float("nan")
    right = np.random.default_rng(1).random((2000, share.size)) < share
    inside = np.eye(_BINS)[_bins(share)]
    return float(np.abs((right - share) @ inside).sum(axis=1).mean() / share.size)


def _predicted(scores: pd.DataFrame) -> NDArray[np.float64]:
    """Probability of the first rank; where several effects are true, of all that are right."""
    return np.where(scores["top_right"], scores["probability_right"], scores["probability"]).astype(
        float
    )


def _bins(share: NDArray[np.float64]) -> NDArray[np.int64]:
    return np.clip((share * _BINS).astype(np.int64), 0, _BINS - 1)


def gap_left(scores: pd.DataFrame) -> float:
    """Share of the exactly explained logs whose residual is at most `GAP_GOAL` sigma."""
    right = scores[(scores["expected"] == "explained") & scores["exact"]]
    return float((right["gap_after"] <= GAP_GOAL).mean()) if len(right) else float("nan")
