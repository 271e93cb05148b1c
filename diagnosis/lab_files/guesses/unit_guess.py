"""The unit of a column: from its name; else from its magnitude, as a question; else unknown."""

from dataclasses import dataclass

import numpy as np

from diagnosis.criteria.lab_files import (
    METRES_AT_MOST,
    MICROSECONDS_AT_LEAST,
    MILLISECONDS_AT_LEAST,
    NANOSECONDS_AT_LEAST,
    RADIANS_AT_MOST,
)
from diagnosis.criteria.log import LONGEST_SAMPLE_S, SHORTEST_SAMPLE_S
from diagnosis.lab_files.readers.lab_table import Array
from diagnosis.lab_files.units import MeasuredQuantity, factor_of, unit_in

_ROS = {
    MeasuredQuantity.ANGLE: "rad",
    MeasuredQuantity.ANGULAR_RATE: "rad/s",
    MeasuredQuantity.TORQUE: "N m",
    MeasuredQuantity.LENGTH: "m",
    MeasuredQuantity.SPEED: "m/s",
    MeasuredQuantity.TIME: "s",
}


@dataclass(frozen=True, kw_only=True)
class UnitGuess:
    """A unit, and how it was found.

    Attributes:
      unit: as the file writes it; None: unknown.
      known: whether its factor is known for the quantity; else the user has to state one.
      asked: whether the reason ends in a question that the user should answer.
    """

    unit: str | None
    known: bool
    asked: bool
    reason: str


def guessed_unit(name: str, values: Array, quantity: MeasuredQuantity, *, ros_units: bool) -> UnitGuess:
    """The unit of a column that measures a quantity."""
    if ros_units:
        return UnitGuess(unit=_ROS[quantity], known=True, asked=False, reason="ROS's units (REP 103)")
    stated = name if factor_of(name, quantity) is not None else unit_in(name)
    if stated and quantity == MeasuredQuantity.TIME and (doubt := _doubt(stated, values)):
        return UnitGuess(unit=None, known=False, asked=True, reason=doubt)
    if stated and factor_of(stated, quantity) is not None:
        return UnitGuess(unit=stated, known=True, asked=False, reason="from the name")
    if stated:
        reason = f"{stated!r} in the name is no known {_in_words(quantity)}: how many {quantity} is it?"
        return UnitGuess(unit=stated, known=False, asked=True, reason=reason)
    return _by_magnitude(values, quantity)


def _doubt(stated: str, values: Array) -> str:
    """Why times cannot be in the unit of their name, as a question; empty if they can."""
    step = _step(values)
    found_s = step * (factor_of(stated, MeasuredQuantity.TIME) or 0.0)
    if found_s <= 0 or SHORTEST_SAMPLE_S <= found_s <= LONGEST_SAMPLE_S:
        return ""
    likely = _time_unit(step)
    likely_s = step * (factor_of(likely, MeasuredQuantity.TIME) or 0.0)
    return (
        f"{stated!r} in the name would put the rows {found_s:.2g} s apart, {likely!r} {likely_s:.2g} s: "
        "which is it?"
    )


def _by_magnitude(values: Array, quantity: MeasuredQuantity) -> UnitGuess:
    finite = values[np.isfinite(values)]
    span, most = (float(np.ptp(finite)), float(np.abs(finite).max())) if finite.size else (0.0, 0.0)
    unit: str | None
    match quantity:
        case MeasuredQuantity.TIME:
            step = _step(values)
            unit, said = _time_unit(step), f"the step is {step:.4g}"
        case MeasuredQuantity.ANGLE:
            unit = "rad" if span <= RADIANS_AT_MOST else "deg"
            said = f"it turns by {span:.4g}, which would be {np.degrees(span):.4g} deg if it were in rad"
        case MeasuredQuantity.LENGTH:
            unit, said = "m" if most <= METRES_AT_MOST else "mm", f"it reaches {most:.4g}"
        case _:
            unit, said = None, f"it reaches {most:.4g}"
    question = f"{said}: is it in {unit}?" if unit else f"{said}: what is its unit?"
    return UnitGuess(
        unit=unit, known=unit is not None, asked=True, reason=f"the name states no unit; {question}"
    )


def _step(values: Array) -> float:
    finite = values[np.isfinite(values)]
    return float(np.median(np.diff(finite))) if finite.size > 1 else 0.0


def _time_unit(step: float) -> str:
    if step >= NANOSECONDS_AT_LEAST:
        return "ns"
    if step >= MICROSECONDS_AT_LEAST:
        return "us"
    return "ms" if step >= MILLISECONDS_AT_LEAST else "s"


def _in_words(quantity: MeasuredQuantity) -> str:
    return f"unit of {quantity.name.lower().replace('_', ' ')}"
