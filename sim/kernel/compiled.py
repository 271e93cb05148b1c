"""How kernel functions are compiled: into one, with C's arithmetic on division."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]

# No reordering of sums (results do not depend on the machine's vector width).
# No counting of references: nothing here allocates, and the counters' calls cost more than the sums.
_OPTIONS: dict[str, Any] = {
    "error_model": "numpy",
    "fastmath": {"contract", "arcp", "nsz"},
    "_nrt": False,
}


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function that becomes part of its caller."""
    return njit(inline="always", **_OPTIONS)(function)


def embedded(function: Callable[..., Any]) -> Any:
    """Compile a function that LLVM is made to put into its callers."""
    return njit(forceinline=True, **_OPTIONS)(function)
