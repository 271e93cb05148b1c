"""Plausibility of a log that can be used anyway: each finding is a warning in the report.

A clean log has none. Data with a warning are used as they are, since they may be right: a
trial that does not start at rest looks like one of a sensor with an offset.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.checks import (
    COMMON_PAUSES,
    LARGE_TURN_DEG,
    PAUSE_STEPS,
    PAUSE_STEPS_UNEVEN,
    REST_SAMPLES,
    REST_SIGMA,
    STILL_SIGMA,
    TIP_QUIET,
    TIP_TURNS_AT_LEAST,
    TIP_TURNS_AT_MOST,
    TURN_LEAST_DEG,
    TURN_LEAST_SIGMA,
    UNEVEN_QUARTILES,
)
from diagnosis.log.checks.lengths import length_warnings
from diagnosis.log.checks.wording import lines, listed
from diagnosis.log.faults.scatter import quantum, scatter
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]

_UNITS = {"tip_angle_deg": "deg", "base_torque_n_mm": "N mm"}
_ANGLES = ("base_angle_deg", "tip_angle_deg")


def plausibility_warnings(trials: Sequence[Trial], noise: Mapping[str, float]) -> list[str]:
    """Warnings about usable trials, given claimed noise by column."""
    found = []
    for trial in trials:
        found += [*_gaps(trial), *length_warnings(trial), *_other_angle_units(trial, noise)]
    for name, claim in noise.items():
        having = [trial for trial in trials if trial.has(name)]
        found += [*_coarse(name, having, claim), *_free_of_noise(name, having, claim)]
    return [*found, *_absent(trials), *_not_at_rest(trials, noise)]


def _gaps(trial: Trial) -> list[str]:
    """Warnings about pauses of a log that otherwise samples often."""
    steps = np.diff(trial["time_s"])
    low, median, high = np.quantile(steps, [0.25, 0.5, 0.75])
    pauses = steps > (PAUSE_STEPS if high < UNEVEN_QUARTILES * low else PAUSE_STEPS_UNEVEN) * median
    if not pauses.any() or pauses.mean() > COMMON_PAUSES:
        return []
    rows = np.concatenate(([False], pauses))
    return [
        f"{trial.name}: time_s jumps by up to {steps.max():.3g} s before {lines(rows)}; "
        "the base is taken to have moved smoothly across the gap; where it turned fast there, the "
        "readings after it are not used until the needle has forgotten it"
    ]


def _other_angle_units(trial: Trial, noise: Mapping[str, float]) -> list[str]:
    """Warnings if the tip turns like the base in other units: far more or less, including noise."""
    if not trial.has("tip_angle_deg") or trial.tip_is_loaded:
        return []
    base, tip = (float(np.nanmax(a) - np.nanmin(a)) for a in map(trial.__getitem__, _ANGLES))
    turns = base >= max(TURN_LEAST_DEG, TURN_LEAST_SIGMA * noise["base_angle_deg"])
    if not turns and tip < max(LARGE_TURN_DEG, TURN_LEAST_SIGMA * noise["tip_angle_deg"]):
        return []
    ratio = tip / max(base, 1e-9)
    quiet = scatter(trial["tip_angle_deg"]) < TIP_QUIET * noise["tip_angle_deg"]
    if TIP_TURNS_AT_LEAST < ratio < TIP_TURNS_AT_MOST or (ratio < 1 and not quiet):
        return []
    return [
        f"{trial.name}: tip_angle_deg turns {ratio:.3g} times as far as base_angle_deg; check the unit "
        f"of {_ANGLES[ratio < 1]} (radians: multiply it by 57.2958)"
    ]


def _coarse(name: str, having: Sequence[Trial], claim: float) -> list[str]:
    """Warnings if rounding to steps of q, a noise of q / sqrt(12), exceeds the claim."""
    steps = min((q for trial in having if (q := quantum(trial[name])) > 0), default=0.0)
    if not 0 < claim < steps / np.sqrt(12):
        return []
    return [
        f"{name}: its smallest step is {steps:.3g}, which alone scatters by {steps / np.sqrt(12):.3g}; "
        f"rig.yaml claims a noise of {claim:.3g}: log more digits, or claim more noise"
    ]


def _free_of_noise(name: str, having: Sequence[Trial], claim: float) -> list[str]:
    if claim > 0 or not having or name not in SENSORS:
        return []
    return [f"{name}: rig.yaml claims a noise of 0, which no sensor has; the data's own scatter is used"]


def _absent(trials: Sequence[Trial]) -> list[str]:
    found = []
    for sensor in SENSORS:
        without = [trial.name for trial in trials if not trial.has(sensor)]
        if 0 < len(without) < len(trials):
            found.append(f"{listed(without)}: no reading of {sensor}; the other signals are used there")
    return found


def _not_at_rest(trials: Sequence[Trial], noise: Mapping[str, float]) -> list[str]:
    """Warnings if trials do not start untwisted, with the tip at the angle of the base and no torque."""
    warnings = []
    for sensor, meant in (("tip_angle_deg", "base_angle_deg"), ("base_torque_n_mm", "0")):
        off = {
            trial.name: offset
            for trial in trials
            if trial.has(sensor) and (offset := _offset(trial, sensor, noise))
        }
        if off:
            first = next(iter(off))
            warnings.append(
                f"{listed(off)}: {sensor} starts away from {meant} (by {off[first]:.3g} "
                f"{_UNITS[sensor]} in {first}); "
                "a trial should start untwisted and at rest, but an offset of the sensor looks the same"
            )
    return warnings


def _offset(trial: Trial, sensor: str, noise: Mapping[str, float]) -> float:
    """Mean of the first readings, off rest, while the base has not moved; 0 within the noise."""
    base = trial["base_angle_deg"][:REST_SAMPLES]
    still = np.abs(base - base[0]) <= STILL_SIGMA * noise["base_angle_deg"]
    first = slice(0, int(np.argmin(still)) if not still.all() else base.size)
    read = trial[sensor][first] - (trial["base_angle_deg"][first] if sensor == "tip_angle_deg" else 0.0)
    read = read[np.isfinite(read)]
    one = np.nanmax([noise[sensor], scatter(trial[sensor]), 0.0])
    if read.size == 0 or not one > 0 or abs(read.mean()) <= REST_SIGMA * one / np.sqrt(read.size):
        return 0.0
    return float(read.mean())
