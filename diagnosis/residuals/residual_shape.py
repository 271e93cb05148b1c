"""The shape of a residual: along the motion, its autocorrelation, its spectrum, which signal leads."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from diagnosis.log.trial import SENSORS
from diagnosis.residuals.along_motion import BASE_ANGLE, RATE, SINCE_REVERSAL, Coordinate, part_means
from diagnosis.residuals.autocorrelation import Autocorrelation, autocorrelation
from diagnosis.residuals.lead import Lead, lead
from diagnosis.residuals.spectrum import Spectrum, spectrum
from diagnosis.residuals.trial_residual import TrialResidual, by_sensor, on_even_steps, sample_s

Array = NDArray[np.float64]
Known = TypeVar("Known")


@dataclass(frozen=True, kw_only=True)
class ResidualShape:
    """Root mean square of residual / sigma along the motion, and the structure of the residual.

    Attributes:
      base_angle_deg: mean base angle in a twelfth of its range, and the residual there.
      since_reversal_s: mean time since the base last began to turn the other way, and the residual.
      rate_deg_s: mean rate of the base, with its sign, and the residual.
      autocorrelation, spectrum: by sensor.
      leads: which sensor's residual leads; None without both sensors.
    """

    base_angle_deg: list[tuple[float, float]]
    since_reversal_s: list[tuple[float, float]]
    rate_deg_s: list[tuple[float, float]]
    autocorrelation: dict[str, Autocorrelation]
    spectrum: dict[str, Spectrum]
    leads: Lead | None


def residual_shape(residuals: Sequence[TrialResidual]) -> ResidualShape:
    """The shape of residuals of the trials of a log."""
    step = sample_s(residuals)
    even = {
        sensor: [on_even_steps(residual, sensor, step) for residual in own]
        for sensor, own in by_sensor(residuals).items()
    }
    return ResidualShape(
        base_angle_deg=_along(BASE_ANGLE, residuals),
        since_reversal_s=_along(SINCE_REVERSAL, residuals),
        rate_deg_s=_along(RATE, residuals),
        autocorrelation=_known({s: autocorrelation(own, step) for s, own in even.items()}),
        spectrum=_known({s: spectrum(own, step) for s, own in even.items()}),
        leads=lead(SENSORS, _both(residuals, step), step),
    )


def _along(coordinate: Coordinate, residuals: Sequence[TrialResidual]) -> list[tuple[float, float]]:
    """Root mean squares in the parts of a coordinate."""
    places = [coordinate.of(residual.trial) for residual in residuals]
    squares = [residual.squares for residual in residuals]
    means = part_means(places, squares, coordinate.edges(places))
    return [(place, float(np.sqrt(mean))) for place, mean in means]


def _both(residuals: Sequence[TrialResidual], step_s: float) -> list[tuple[Array, Array]]:
    """Residuals of both sensors at even steps, of the trials that have both."""
    first, second = SENSORS
    return [
        (on_even_steps(residual, first, step_s), on_even_steps(residual, second, step_s))
        for residual in residuals
        if {first, second} <= residual.left.keys()
    ]


def _known(found: Mapping[str, Known | None]) -> dict[str, Known]:
    return {sensor: one for sensor, one in found.items() if one is not None}
