"""Noise of the sensors: the scatter of their readings, from the data themselves.

Claims are usually right to about 15 %. If the scatter of the data is less than half or more than twice
the claim, that of the data is used, with a warning.
"""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.checks import NOISE_RATIO
from diagnosis.criteria.noise import (
    COLOUR_AT_ONCE_SHARE,
    COLOUR_CHI_SQUARE,
    COLOUR_FAR_ABOVE_CLAIM,
    COLOUR_LEAST_SHARE,
    COLOUR_MOST,
    LEAST_GAP,
)
from diagnosis.criteria.prepare import LEAST_DIFFERENCES
from diagnosis.log.faults.scatter import agrees
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import BASE, SENSORS, Trial
from diagnosis.log.white_noise import white_noise
from diagnosis.prepare.noise.colour import Colour
from diagnosis.prepare.noise.drift import AllowedDrift, Drift
from diagnosis.prepare.noise.spectrum.flicker import flicker_noise
from diagnosis.prepare.noise.spectrum.time_or_rows import colour_in_time_or_rows
from diagnosis.prepare.noise.varying_noise import VaryingNoise
from diagnosis.prepare.prepared_log import PreparedTrial

Array = NDArray[np.float64]
TimedArray = tuple[Array, Array]

_ORDER = 4  # of differences, which a residual of a wrong model asks for
_UNKNOWN = 1.0  # where nothing is claimed and too little was read


@dataclass(frozen=True, kw_only=True)
class Noise:
    """Noise of the sensors and of the base's encoder.

    Attributes:
      sigma: standard deviation, by sensor and of the encoder.
      warnings: warnings about the noise.
      colour: colour of the noise, for sensors whose noise is not white.
      white: standard deviation by sensor, if all noise is taken as white.
      least: least noise of readings in coarse steps.
      most: largest noise that may be coloured: more is what the model lacks.
      means_of: number of readings that a sample is the mean of.
      colour_chi_square: by which white noise has to fit a spectrum worse for noise to be coloured.
      flicker: sensors whose noise is flicker noise, and the frequency, Hz, above which it is looked at.
      drifts: drift that sensors may have within a trial.
      varies: how the noise of sensors varies, whose samples then have weights.
    """

    sigma: Mapping[str, float]
    warnings: tuple[str, ...] = field(default=())
    colour: Mapping[str, Colour] = field(default_factory=dict)
    white: Mapping[str, float] = field(default_factory=dict)
    least: Mapping[str, float] = field(default_factory=dict)
    most: Mapping[str, float] = field(default_factory=dict)
    means_of: int = 1
    colour_chi_square: float = COLOUR_CHI_SQUARE
    flicker: Mapping[str, float] = field(default_factory=dict)
    drifts: Mapping[str, AllowedDrift] = field(default_factory=dict)
    varies: Mapping[str, tuple[VaryingNoise, ...]] = field(default_factory=dict)

    def __getitem__(self, sensor: str) -> float:
        return self.sigma[sensor]

    def whitened(self, sensor: str, time_s: Array, values: Array) -> Array:
        """Whitened residuals of a sensor / sigma, (N,) or (N, n), without what may be drift."""
        colour, drift = self.colour.get(sensor), self.drift(sensor)
        white = colour.whitened(time_s, values) if colour else values
        return drift.whitened(time_s, white) if drift else white

    def restored(self, sensor: str, time_s: Array, whitened: Array) -> Array:
        """Residuals / sigma from whitened ones."""
        colour, drift = self.colour.get(sensor), self.drift(sensor)
        white = drift.restored(time_s, whitened) if drift else whitened
        return colour.restored(time_s, white) if colour else white

    def drift(self, sensor: str) -> Drift | None:
        """The drift that a sensor may have; None: none."""
        own = self.drifts.get(sensor)
        if own is None:
            return None
        size_sigma = own.size / self.sigma[sensor]
        return Drift(size_sigma=size_sigma, zeroed=own.zeroed, colour=self.colour.get(sensor))

    def with_drift(self, sensor: str, allowed: AllowedDrift | None) -> "Noise":
        """The noise with another drift of a sensor; None: without one."""
        others = {name: own for name, own in self.drifts.items() if name != sensor}
        return replace(self, drifts=others | {sensor: allowed} if allowed else others)

    def with_colour(
        self,
        left: Mapping[str, Sequence[TimedArray]],
        least_share: float = COLOUR_LEAST_SHARE,
        most_parts: Mapping[str, int] | None = None,
    ) -> "Noise":
        """The noise with the colour of residuals, in the units of the sensors, by sensor and trial.

        Args:
          most_parts: correlated parts of it, by sensor; otherwise 1.
        """
        sigma, colour, most = dict(self.sigma), {}, most_parts or {}
        for sensor, parts in left.items():
            found = self._flicker(sensor, parts) or colour_in_time_or_rows(
                parts, least_share, self.means_of, self.colour_chi_square, most.get(sensor, 1)
            )
            if found and found[0] <= self.most.get(sensor, np.inf):
                sigma[sensor], colour[sensor] = found
            elif sensor in self.colour:  # it was taken for coloured, and is not
                sigma[sensor] = self.white[sensor]
        return replace(self, sigma=sigma, colour=colour)

    def _flicker(self, sensor: str, parts: Sequence[TimedArray]) -> tuple[float, Colour] | None:
        above_hz = self.flicker.get(sensor)
        found = flicker_noise(parts, self.means_of, above_hz) if above_hz else None
        return found.noise if found else None

    def varying(self, found: Mapping[str, VaryingNoise]) -> "Noise":
        """The noise of which that of some sensors also varies."""
        sigma = {s: own * found[s].noise_ratio if s in found else own for s, own in self.sigma.items()}
        more = {s: (*self.varies.get(s, ()), own) for s, own in found.items()}
        return replace(self, sigma=sigma, varies={**self.varies, **more})

    def sizes(self, sensor: str, trial: PreparedTrial) -> Array:
        """Noise of a sensor at every sample / its root mean square over the log, (N,)."""
        sizes = np.ones(trial.time_s.size)
        for own in self.varies.get(sensor, ()):
            sizes = sizes * own.sizes(trial)
        return sizes

    def same(self, other: "Noise") -> bool:
        """Whether residuals in units of both are the same."""
        return (self.sigma, self.colour, self.drifts) == (other.sigma, other.colour, other.drifts)

    def alike(self, other: "Noise", sensor: str) -> bool:
        """Whether the noise of a sensor differs in its size alone."""
        return self.colour.get(sensor) == other.colour.get(sensor) and (
            self.drift(sensor) == other.drift(sensor)
        )

    @property
    def uncoloured(self) -> "Noise":
        """Noise of the same size, taken as white beside drift: for figures."""
        return replace(self, colour={})

    @property
    def notes(self) -> tuple[str, ...]:
        """Warnings, and the sensors whose noise is not white or varies."""
        each = (
            f"{sensor}: {100 * min(colour.share, 1.0):.0f} % of the noise's variance is correlated "
            f"{colour.in_words}; the diagnosis allows for it"
            for sensor, colour in self.colour.items()
        )
        varies = (
            f"{sensor}: the noise {own.in_words}; samples count accordingly"
            for sensor, found in self.varies.items()
            for own in found
        )
        return (*self.warnings, *each, *varies)


def estimate_noise(
    rig: NominalRig,
    residuals: Mapping[str, Sequence[TimedArray]],
    base_sigma_deg: float,
    told: Collection[str] = (),
    least: Mapping[str, float] | None = None,
    means_of: int = 1,
    smoothed: Collection[str] = (),
) -> Noise:
    """Noise of a log.

    Args:
      residuals: times, s, and measured minus nominal, by sensor and trial, (N,) each.
      base_sigma_deg: noise of the base's encoder.
      told: columns whose claim has already had a warning.
      least: noise of columns in coarse steps, which differences of constant readings do not show.
      means_of: number of readings that a sample is the mean of.
      smoothed: sensors whose rows are rare, since they were smoothed.
    """
    least = least or {}
    claims = rig.sensors.by_column()
    sigma, warnings = (
        {BASE: base_sigma_deg},
        {BASE: _scatters_otherwise(BASE, base_sigma_deg, claims[BASE], means_of)},
    )
    left = {sensor: [values for _, values in residuals.get(sensor, ())] for sensor in SENSORS}
    for sensor in SENSORS:
        found = white_noise(left[sensor], order=_ORDER)
        if not np.isfinite(found) or found <= 0:
            found = claims[sensor] or _UNKNOWN
        if sensor in smoothed:  # differences of rare rows are those of the motion
            found = min(found, NOISE_RATIO[1] * claims[sensor])
        found = max(found, least.get(sensor, 0.0))
        sigma[sensor] = found
    most = {s: _most_coloured(sigma[s], claims[s]) for s in SENSORS}
    noise = Noise(sigma=sigma, white=sigma, most=most, means_of=means_of).with_colour(
        residuals, COLOUR_AT_ONCE_SHARE
    )
    for sensor in SENSORS:
        warnings[sensor] = _scatters_otherwise(
            sensor, noise[sensor], claims[sensor], means_of
        ) or _below_noise(sensor, left[sensor], noise[sensor])
    said = tuple(warning for column, warning in warnings.items() if warning and column not in told)
    return replace(noise, warnings=said, least=least)


def _most_coloured(scatter: float, claimed: float) -> float:
    """Largest noise that may be coloured, if readings scatter so much from sample to sample."""
    if claimed <= 0:
        return math.inf
    if scatter > COLOUR_FAR_ABOVE_CLAIM * claimed:
        return 0.0
    return COLOUR_MOST * max(claimed, scatter) if agrees(scatter, claimed) else math.inf


def _scatters_otherwise(column: str, found: float, claimed: float, means_of: int) -> str:
    if claimed <= 0 or agrees(found, claimed):
        return ""
    found, claimed = (math.sqrt(means_of) * own for own in (found, claimed))  # of a single reading
    return (
        f"{column}: the readings scatter by {found:.3g}, rig.yaml claims {claimed:.3g}; "
        "the readings are believed: correct rig.yaml, or look for a fast disturbance"
    )


def _below_noise(sensor: str, residuals: Sequence[Array], sigma: float) -> str:
    """Warning if the residual is far below the noise: the column may be in another unit."""
    left = np.concatenate([part[np.isfinite(part)] for part in residuals]) if residuals else np.zeros(0)
    gap = float(np.sqrt(np.mean(left**2))) / sigma if left.size >= LEAST_DIFFERENCES else 1.0
    if gap >= LEAST_GAP:
        return ""
    return (
        f"{sensor}: the residual of the nominal rig is {gap:.2g} of the noise ({sigma:.3g}), but "
        f"noise alone gives 1; check the units of {sensor} and {BASE} (rad: multiply by 57.2958; N m: "
        "by 1000), and the claimed noise in rig.yaml"
    )


def base_noise_deg(rig: NominalRig, trials: Sequence[Trial]) -> float:
    """Noise of the base's encoder: the claim, unless the scatter of the quietest trial differs.

    Rows that were moved to where the base was do not scatter, and tell nothing.
    """
    claimed = rig.sensors.base_angle_noise_deg
    each = (
        white_noise([_where_not_moved(trial)], order=_ORDER, times_s=[trial["time_s"]])
        for trial in trials
    )
    found = min((own for own in each if np.isfinite(own)), default=np.nan)
    near = claimed > 0 and (not np.isfinite(found) or agrees(found, claimed))
    return claimed if near else float(np.nan_to_num(found))


def _where_not_moved(trial: Trial) -> Array:
    """Readings of the base, (N,); NaN where rows were moved in time by what they read."""
    rows = trial.file_rows
    if rows.errors_s is None:
        return trial[BASE]
    moved = np.interp(trial["time_s"], rows.taken_s, rows.taken_s != rows.stamps_s)
    return np.where(moved > 0, np.nan, trial[BASE])
