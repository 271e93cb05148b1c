"""Noise of the sensors: what their readings scatter by, from the data themselves.

Claims are good to about 15 %. Where the data scatter by less than half or more than twice of what
is claimed, the data are believed, with a warning.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import NOISE_RATIO
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]

BASE = "base_angle_deg"
_ORDER = 4  # of differences, which a residual of a wrong model asks for
_UNKNOWN = 1.0  # where nothing is claimed and too little was read


@dataclass(frozen=True, kw_only=True)
class Noise:
    """One standard deviation by sensor and of the base's encoder, and what was odd about it."""

    sigma: Mapping[str, float]
    warnings: tuple[str, ...] = field(default=())

    def __getitem__(self, sensor: str) -> float:
        return self.sigma[sensor]


def estimate_noise(
    rig: NominalRig, residuals: Mapping[str, Sequence[Array]], base_sigma_deg: float
) -> Noise:
    """Noise of a log.

    Args:
      residuals: measured minus nominal, by sensor and trial.
      base_sigma_deg: of the base's encoder.
    """
    sigma, warnings = {BASE: base_sigma_deg}, []
    for sensor in SENSORS:
        claimed = rig.sensors.by_column()[sensor]
        found = white_noise(residuals.get(sensor, ()), order=_ORDER)
        if not np.isfinite(found) or found <= 0:
            sigma[sensor] = claimed or _UNKNOWN
            continue
        sigma[sensor] = found
        if claimed > 0 and not _agrees(found, claimed):
            warnings.append(
                f"{sensor}: the readings scatter by {found:.3g}, rig.yaml claims {claimed:.3g}; "
                "the readings are believed: correct rig.yaml, or look for a fast disturbance"
            )
    return Noise(sigma=sigma, warnings=tuple(warnings))


def base_noise_deg(rig: NominalRig, trials: Sequence[Trial]) -> float:
    """Of the base's encoder: the claim, unless the quietest trial scatters quite otherwise."""
    claimed = rig.sensors.base_angle_noise_deg
    found = min(white_noise([trial[BASE]], order=_ORDER) for trial in trials)
    near = claimed > 0 and (not np.isfinite(found) or _agrees(found, claimed))
    return claimed if near else float(np.nan_to_num(found))


def _agrees(found: float, claimed: float) -> bool:
    low, high = NOISE_RATIO
    return low <= found / claimed <= high
