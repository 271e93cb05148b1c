"""How a residual is written: over the noise of its sensor, σ, with three significant digits."""

import math

_DIGITS = 3
_MOST_DECIMALS = 3  # what is smaller is nothing beside the noise


def in_sigma(value: float) -> str:
    """A residual with its unit: 12.3 σ, 1.81 σ, 0.996 σ."""
    return f"{over_sigma(value)} σ"


def over_sigma(value: float) -> str:
    """The number alone, for what names its unit elsewhere."""
    rounded = abs(float(f"{value:.{_DIGITS}g}"))
    whole = math.floor(math.log10(rounded)) + 1 if rounded > 0 else 0
    return f"{value:.{min(max(_DIGITS - whole, 0), _MOST_DECIMALS)}f}"
