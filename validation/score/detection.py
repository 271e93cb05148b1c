"""How small an effect may be and still be named: its detection limit.

Logs of one effect are sorted by signature (its root mean square over noise). The limit
is where named turns into not named with the fewest logs on the wrong side, half-way
between its neighbours on a logarithmic scale.
"""

import numpy as np
import pandas as pd
from numpy.typing import NDArray


def limits(scores: pd.DataFrame) -> pd.DataFrame:
    """By effect: logs, the share that was named, and the detection limit over noise.

    The limit is NaN where it lies beside the logs: all, or none, were named, or no order is seen.
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
    """The logs in which one effect, and no second, is true and its signature is known."""
    several = scores["truth"].str.contains(" + ", regex=False)
    return scores[(scores["expected"] == "explained") & ~several & (scores["signature"] > 0)]


def _limit(signature: NDArray[np.float64], named: NDArray[np.bool_]) -> float:
    order = np.argsort(signature)
    sorted_, found = signature[order], named[order]
    named_below = np.concatenate(([0], np.cumsum(found)))
    missed_above = np.concatenate((np.cumsum(~found[::-1])[::-1], [0]))
    best = int(np.argmin(named_below + missed_above))
    if best in (0, len(found)):
        return float("nan")
    return float(np.sqrt(sorted_[best - 1] * sorted_[best]))
