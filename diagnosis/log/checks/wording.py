"""Wording that messages about a log share."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

_SHOWN = 4


def listed(names: Mapping[str, float] | Sequence[str]) -> str:
    """The first names, and the number of the others."""
    shown = list(names)[:_SHOWN]
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")


def lines(rows: NDArray[np.bool_]) -> str:
    """Rows of a table as lines of its file, in words: the header is line 1."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], rows.astype(np.int8), [0]))))
    spans = [
        f"{a + 2}" if b == a + 1 else f"{a + 2}-{b + 1}" for a, b in edges.reshape(-1, 2)[:5].tolist()
    ]
    more = edges.size // 2 - len(spans)
    which = "line" if rows.sum() == 1 else "lines"
    return f"{which} {', '.join(spans)}" + (f" and {more} more" if more else "")
