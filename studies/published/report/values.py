"""Values as text, for sentences and tables."""

from typing import Any

from studies.published.experiments.measurement import Quantity, TurnMeasurement
from studies.published.experiments.schedules import observed_s
from studies.published.fitting.fit import FigureFit


def names_in_words(names: tuple[str, ...]) -> str:
    """A set of mechanisms in words."""
    return " and ".join(names) if names else "nothing"


def with_free_length(fit: FigureFit) -> str:
    """The mechanisms of a fit in words, and its free length."""
    return f"{names_in_words(fit.hypothesis.names)} ({fit.hypothesis.free_length})"


def value_text(measurement: TurnMeasurement, value: float) -> str:
    """A predicted value without its unit; "longer" for a turn that does not settle."""
    longest = observed_s(measurement.depth_mm)
    if measurement.quantity is Quantity.SETTLING and value > longest:
        return f"> {longest:g}"
    return f"{value:.3g}"


def deviation_text(value_mm: float) -> str:
    """A deviation in mm, to a tenth."""
    return f"{value_mm:.1f} mm"


def percent(share: float, digits: int = 0) -> str:
    """A share in percent, with the sign."""
    return f"{100 * share:.{digits}f} %"


def fitted_values(fit: FigureFit) -> dict[str, dict[str, dict[str, Any]]]:
    """Fitted values with 95 % intervals and units, by mechanism and parameter."""
    intervals = iter(fit.intervals())
    found: dict[str, dict[str, dict[str, Any]]] = {}
    for mechanism in fit.hypothesis.mechanisms:
        for p in mechanism.parameters:
            value, low, high = next(intervals)
            entry = {"value": value, "low": low, "high": high, "unit": p.unit}
            found.setdefault(mechanism.name, {})[p.name] = entry
    return found
