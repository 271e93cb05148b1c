"""The detection limit of an effect: how weak it may be and still be named.

Logs of one effect are sorted by its signature (root mean square of the change / sigma). The limit
separates logs below, where it is not named, from logs above, where it is, with the fewest logs on the
wrong side; it lies half-way between its neighbours on a logarithmic scale.
"""

import numpy as np
import pandas as pd
from numpy.typing import NDArray


def detection_limits(scores: pd.DataFrame) -> pd.DataFrame:
    """By effect: number of logs, share in which it is named, smallest signature, detection limit.

    The limit is NaN if the logs do not enclose it: all or none were named, or in no clear order.
    """
    grouped = of_one_effect(scores).groupby("truth")
    rows = {
        effect: {
            "logs": len(own),
            "named": own["exact"].mean(),
            "smallest": own["signature"].min(),
            "limit": _limit(own["signature"].to_numpy(float), own["exact"].to_numpy(bool)),
        }
        for effect, own in grouped
    }
    return pd.DataFrame.from_dict(rows, orient="index", columns=["logs", "named", "smallest", "limit"])


def of_one_effect(scores: pd.DataFrame) -> pd.DataFrame:
    """The logs in which exactly one effect is true and its signature is known."""
    several = scores["truth"].str.contains(" + ", regex=False)
    return scores[(scores["expected"] == "explained") & ~several & (scores["signature"] > 0)]


def _limit(signature: NDArray[np.float64], named: NDArray[np.bool_]) -> float:
    order = np.argsort(signature)
    signature, named = signature[order], named[order]
    named_below = np.concatenate(([0], np.cumsum(named)))
    unnamed_above = np.concatenate((np.cumsum(~named[::-1])[::-1], [0]))
    best = int(np.argmin(named_below + unnamed_above))
    if best in (0, len(named)):
        return float("nan")
    return float(np.sqrt(signature[best - 1] * signature[best]))
