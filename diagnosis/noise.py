"""The noise floor: what the sensors' readings scatter by, from the data itself.

Second differences of measured less nominal leave, of anything that varies slowly,
almost nothing, and of white noise sqrt(6) sigma. Their median absolute value is
not moved by the few samples where a fast turn is not slow. It is reconciled with
what the log claims: a claim is good to about 15 %, so an estimate within a factor
of two of it is taken, and otherwise the claim, with a warning.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from diagnosis.rig_log import SENSORS, RigLog

Array = NDArray[np.float64]

CLAIMS = {
    "tip_angle_deg": "tip_angle_noise_deg",
    "base_torque_n_mm": "base_torque_noise_n_mm",
}
_MAD_TO_SIGMA = 1.4826
_SECOND_DIFFERENCE = np.sqrt(6.0)


@dataclass(frozen=True, kw_only=True)
class Noise:
    """One standard deviation by sensor, and what was odd about it."""

    sigma: dict[str, float]
    warnings: tuple[str, ...] = field(default=())

    def __getitem__(self, sensor: str) -> float:
        return self.sigma[sensor]


def white_noise(values: Array) -> float:
    """Standard deviation of the white part of a signal; NaN from fewer than 20 samples."""
    finite = values[np.isfinite(values)]
    if finite.size < 20:
        return float("nan")
    second = np.diff(finite, n=2)
    return float(_MAD_TO_SIGMA * np.median(np.abs(second - np.median(second))) / _SECOND_DIFFERENCE)


def estimate_noise(log: RigLog, missed: Mapping[str, Sequence[Array]]) -> Noise:
    """Noise of a log, given measured less nominal by sensor and trial."""
    sigma, warnings = {}, []
    for sensor in SENSORS:
        claimed = float(getattr(log.rig.sensors, CLAIMS[sensor]))
        seconds = [np.diff(v[np.isfinite(v)], n=2) for v in missed.get(sensor, ())]
        pooled = np.concatenate(seconds) if seconds else np.zeros(0)
        found = float("nan")
        if pooled.size >= 20:
            found = float(_MAD_TO_SIGMA * np.median(np.abs(pooled)) / _SECOND_DIFFERENCE)
        if np.isfinite(found) and found > 0 and (claimed == 0 or 0.5 <= found / claimed <= 2.0):
            sigma[sensor] = found
        else:
            sigma[sensor] = claimed if claimed > 0 else 1.0
            if np.isfinite(found) and claimed > 0:
                warnings.append(
                    f"{sensor}: the data scatter by {found:.3g}, rig.yaml claims {claimed:.3g}; "
                    "the claim is used"
                )
    return Noise(sigma=sigma, warnings=tuple(warnings))
