"""The noise floor: what the sensors' readings scatter by, from the data themselves.

Fourth differences of measured less nominal leave, of anything that varies slowly,
almost nothing, and of white noise sqrt(70) sigma. The larger quarter of them, which
fast turns may have a part in, is left out. Claims are good to about 15 %; where the
data scatter by less than half or more than twice of what is claimed, the data are
believed, with a warning.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from diagnosis.rig_log import SENSORS, RigLog

Array = NDArray[np.float64]

BASE = "base_angle_deg"
CLAIMS = {
    "tip_angle_deg": "tip_angle_noise_deg",
    "base_torque_n_mm": "base_torque_noise_n_mm",
    BASE: "base_angle_noise_deg",
}
_ORDER = 4
_GAIN = np.sqrt(70.0)  # of the fourth difference on white noise
_KEPT = 0.75  # share of the differences that are used, the smaller ones
_TRUNCATED = 0.60706  # root mean square of a unit normal within its central 75 %
_FEWEST = 20
_UNKNOWN_NOISE = 1.0


@dataclass(frozen=True, kw_only=True)
class Noise:
    """One standard deviation by sensor and of the base angle, and what was odd about it."""

    sigma: dict[str, float]
    warnings: tuple[str, ...] = field(default=())

    def __getitem__(self, sensor: str) -> float:
        return self.sigma[sensor]


def white_noise(parts: Sequence[Array]) -> float:
    """Standard deviation of the white part of signals; NaN from fewer than 20 differences."""
    each = [np.diff(values[np.isfinite(values)], n=_ORDER) for values in parts]
    sizes = np.sort(np.abs(np.concatenate(each))) if each else np.zeros(0)
    if sizes.size < _FEWEST:
        return float("nan")
    kept = sizes[: round(_KEPT * sizes.size)]
    return float(np.sqrt(np.mean(kept**2)) / _TRUNCATED / _GAIN)


def estimate_noise(log: RigLog, missed: Mapping[str, Sequence[Array]]) -> Noise:
    """Noise of a log, given measured less nominal by sensor and trial."""
    sigma, warnings = {BASE: base_noise(log)}, []
    for sensor in SENSORS:
        claimed = float(getattr(log.rig.sensors, CLAIMS[sensor]))
        found = white_noise(missed.get(sensor, ()))
        if not np.isfinite(found) or found <= 0:
            sigma[sensor] = claimed or _UNKNOWN_NOISE
            continue
        sigma[sensor] = found
        if claimed > 0 and not 0.5 <= found / claimed <= 2.0:
            warnings.append(
                f"{sensor}: the readings scatter by {found:.3g}, rig.yaml claims {claimed:.3g}; "
                "the readings are believed: correct rig.yaml, or look for a fast disturbance"
            )
    return Noise(sigma=sigma, warnings=tuple(warnings))


def base_noise(log: RigLog) -> float:
    """Of the base angle, deg: the claim, unless the quietest trial scatters quite otherwise."""
    claimed = log.rig.sensors.base_angle_noise_deg
    found = min(white_noise([trial[BASE]]) for trial in log.trials)
    near = claimed > 0 and (not np.isfinite(found) or 0.5 <= found / claimed <= 2.0)
    return claimed if near else float(np.nan_to_num(found))
