"""What the scores of many logs add up to: how often right, how sure, how honest."""

import numpy as np
import pandas as pd

GAP_GOAL = 1.03


def summary(scores: pd.DataFrame) -> pd.DataFrame:
    """By kind: logs, exact, undecided, median seconds."""
    grouped = scores.groupby("kind")
    return pd.DataFrame(
        {
            "logs": grouped.size(),
            "exact": grouped["exact"].mean(),
            "undecided": grouped["verdict"].apply(lambda v: float((v == "undecided").mean())),
            "unknown": grouped["verdict"].apply(lambda v: float((v == "unknown").mean())),
            "seconds": grouped["seconds"].median(),
        }
    )


def coverage(scores: pd.DataFrame) -> tuple[float, int]:
    """Share of the 95 % intervals that cover, and how many there are."""
    count = int(scores["intervals"].sum())
    return (float(scores["inside"].sum() / count) if count else float("nan")), count


def hidden_below(scores: pd.DataFrame) -> tuple[float, int]:
    """Of the effects that went unseen: share no stronger than the report said, and how many."""
    unseen = scores.loc[scores["verdict"] == "none", "over_hidden"].dropna()
    return (float((unseen <= 1.0).mean()) if len(unseen) else float("nan")), len(unseen)


def reliability(scores: pd.DataFrame, bins: int = 5) -> pd.DataFrame:
    """Probability of the first in the ranking against how often it was right.

    Where two effects are true, the probability of both together is that of the pair.
    """
    scores = scores[scores["probability"].notna()]
    share = np.where(scores["top_right"], scores["probability_right"], scores["probability"])
    edges = np.clip((share * bins).astype(int), 0, bins - 1)
    table = pd.DataFrame({"bin": edges, "said": share, "was": scores["top_right"].astype(float)})
    grouped = table.groupby("bin")
    return pd.DataFrame(
        {"said": grouped["said"].mean(), "was": grouped["was"].mean(), "logs": grouped.size()}
    )


def calibration_error(scores: pd.DataFrame) -> float:
    """Expected calibration error: mean distance of said and was, weighted by logs."""
    table = reliability(scores)
    return float((table["logs"] * (table["said"] - table["was"]).abs()).sum() / table["logs"].sum())


def gap_left(scores: pd.DataFrame) -> float:
    """Share of the rightly explained logs whose gap is left within 3 % of the noise."""
    right = scores[(scores["expected"] == "explained") & scores["exact"]]
    return float((right["gap_after"] <= GAP_GOAL).mean()) if len(right) else float("nan")
