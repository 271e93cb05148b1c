"""Noise of the sensors: what their readings scatter by, from the data themselves.

Claims are good to about 15 %. Where the data scatter by less than half or more than twice of what
is claimed, the data are believed, with a warning.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import LEAST_DIFFERENCES, LEAST_GAP, NOISE_RATIO
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]

BASE = "base_angle_deg"
_ORDER = 4  # of differences, which a residual of a wrong model asks for
_UNKNOWN = 1.0  # where nothing is claimed and too little was read


@dataclass(frozen=True, kw_only=True)
class Noise:
    """One standard deviation by sensor and of the base's encoder, and what was odd about it.

    Attributes:
      least: what readings in coarse steps have at least.
    """

    sigma: Mapping[str, float]
    warnings: tuple[str, ...] = field(default=())
    least: Mapping[str, float] = field(default_factory=dict)

    def __getitem__(self, sensor: str) -> float:
        return self.sigma[sensor]


def estimate_noise(
    rig: NominalRig,
    residuals: Mapping[str, Sequence[Array]],
    base_sigma_deg: float,
    told: Collection[str] = (),
    least: Mapping[str, float] | None = None,
) -> Noise:
    """Noise of a log.

    Args:
      residuals: measured minus nominal, by sensor and trial.
      base_sigma_deg: of the base's encoder.
      told: columns whose claim has been doubted before.
      least: noise of columns in coarse steps, which differences of standing readings do not show.
    """
    least = least or {}
    claims = rig.sensors.by_column()
    sigma, warnings = (
        {BASE: base_sigma_deg},
        {BASE: _scatters_otherwise(BASE, base_sigma_deg, claims[BASE])},
    )
    for sensor in SENSORS:
        found = white_noise(residuals.get(sensor, ()), order=_ORDER)
        if not np.isfinite(found) or found <= 0:
            found = claims[sensor] or _UNKNOWN
        found = max(found, least.get(sensor, 0.0))
        sigma[sensor] = found
        warnings[sensor] = _scatters_otherwise(sensor, found, claims[sensor]) or _below_noise(
            sensor, residuals.get(sensor, ()), found
        )
    said = tuple(warning for column, warning in warnings.items() if warning and column not in told)
    return Noise(sigma=sigma, warnings=said, least=least)


def _scatters_otherwise(column: str, found: float, claimed: float) -> str:
    if claimed <= 0 or _agrees(found, claimed):
        return ""
    return (
        f"{column}: the readings scatter by {found:.3g}, rig.yaml claims {claimed:.3g}; "
        "the readings are believed: correct rig.yaml, or look for a fast disturbance"
    )


def _below_noise(sensor: str, residuals: Sequence[Array], sigma: float) -> str:
    """Noise alone leaves a residual of 1 sigma; far less is left where all of it is in another unit."""
    left = np.concatenate([part[np.isfinite(part)] for part in residuals]) if residuals else np.zeros(0)
    gap = float(np.sqrt(np.mean(left**2))) / sigma if left.size >= LEAST_DIFFERENCES else 1.0
    if gap >= LEAST_GAP:
        return ""
    return (
        f"{sensor}: the nominal rig misses the readings by {gap:.2g} of their noise ({sigma:.3g}), and "
        f"noise alone makes 1; check the units of {sensor} and {BASE} (rad: multiply by 57.2958; N m: "
        "by 1000), and the claimed noise in rig.yaml"
    )


def base_noise_deg(rig: NominalRig, trials: Sequence[Trial]) -> float:
    """Of the base's encoder: the claim, unless the quietest trial scatters quite otherwise."""
    claimed = rig.sensors.base_angle_noise_deg
    found = min(white_noise([trial[BASE]], order=_ORDER) for trial in trials)
    near = claimed > 0 and (not np.isfinite(found) or _agrees(found, claimed))
    return claimed if near else float(np.nan_to_num(found))


def _agrees(found: float, claimed: float) -> bool:
    low, high = NOISE_RATIO
    return low <= found / claimed <= high
