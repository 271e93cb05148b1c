"""Doubts about a log that can be used all the same: each is a warning of the report.

A clean log raises none. What raises one is used as it is, since it may be true: a
trial that does not start at rest reads like a sensor with an offset.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.faults import lines, quantum, scatter
from diagnosis.trial import SENSORS, Trial

Array = NDArray[np.float64]

_GAP, _GAP_OF_UNEVEN = 10.0, 30.0  # median sampling intervals
_COMMON = 0.05  # share of long intervals from which they are the log's way of sampling
_REST_SAMPLES = 10
_REST = 5.0  # standard deviations of the mean
_STILL = 3.0  # standard deviations of the base angle
_SLACK_MM = 2.0  # by which lengths may disagree with the speed
_SLACK = 0.2
TORQUE_OVER_TWIST = 5.0  # friction near the chuck, or a stiffer needle, give up to about 2
_MORE_THAN_DEG, _LESS_THAN_DEG = 20.0, 0.03  # turn of the tip over that of the base
_ENDS_MM = 20.0  # of shaft at least that a torque twists


def doubts_of_log(
    trials: Sequence[Trial], noise: Mapping[str, float], rigidity_n_mm2: float
) -> list[str]:
    """Warnings about usable trials, given claimed noise by column and nominal rigidity."""
    found = _too_much_torque(trials, rigidity_n_mm2)
    for trial in trials:
        found += [*_gaps(trial), *_lengths(trial), *_other_angle_units(trial, noise)]
    for name, claim in noise.items():
        having = [trial for trial in trials if trial.has(name)]
        found += [*_coarse(name, having, claim), *_free_of_noise(name, having, claim)]
    return [*found, *_absent(trials), *_not_at_rest(trials, noise)]


def torque_over_twist(
    base_angle_deg: Array, tip_angle_deg: Array, torque_n_mm: Array, stiffness_n_mm_per_rad: float
) -> float:
    """The largest torque over what the largest twist gives a spring of that stiffness."""
    twist = np.nanmax(np.abs(np.radians(base_angle_deg - tip_angle_deg)), initial=1e-9)
    return float(np.nanquantile(np.abs(torque_n_mm), 0.99) / (stiffness_n_mm_per_rad * twist))


def stiffest_n_mm_per_rad(trial: Trial, rigidity_n_mm2: float) -> float:
    """Torsional stiffness of the shaft that is free at least: tissue holds the rest."""
    return rigidity_n_mm2 / max(float(trial["free_mm"].min()), _ENDS_MM)


def _gaps(trial: Trial) -> list[str]:
    """Pauses of a log that otherwise samples often."""
    steps = np.diff(trial["time_s"])
    low, median, high = np.quantile(steps, [0.25, 0.5, 0.75])
    pauses = steps > (_GAP if high < 1.5 * low else _GAP_OF_UNEVEN) * median
    if not pauses.any() or pauses.mean() > _COMMON:
        return []
    rows = np.concatenate(([False], pauses))
    return [
        f"{trial.name}: time_s jumps by up to {steps.max():.3g} s before {lines(rows)}; "
        "the base is taken to have moved smoothly across the gap; where it turned fast there, the "
        "readings of the second after are not used"
    ]


def _lengths(trial: Trial) -> list[str]:
    """Free length and axial speed: the one shrinks by what the other goes in."""
    travel = travelled_mm(trial)
    shrunk = trial["free_mm"][0] - trial["free_mm"]
    slack = _SLACK_MM + _SLACK * max(np.ptp(travel), np.ptp(shrunk))
    if np.abs(shrunk - travel).max() <= slack:
        return []
    opposite = np.abs(shrunk + travel).max() <= slack
    mend = "speed_mm_s seems to have the wrong sign" if opposite else "check units and zero of both"
    end = int(np.argmax(np.abs(travel) + np.abs(shrunk)))
    return [
        f"{trial.name}: free_mm and speed_mm_s disagree: by line {end + 2} speed_mm_s adds up to "
        f"{travel[end]:.3g} mm into the tissue, and free_mm has changed by {-shrunk[end]:.3g} mm "
        f"instead of {-travel[end]:.3g}; {mend}; both are used as they are"
    ]


def travelled_mm(trial: Trial) -> Array:
    """Axial travel into the tissue since the start, from the speed, mm."""
    speed = trial["speed_mm_s"]
    parts = np.diff(trial["time_s"]) * (speed[1:] + speed[:-1]) / 2
    return np.concatenate(([0.0], np.cumsum(parts)))


def _too_much_torque(trials: Sequence[Trial], rigidity_n_mm2: float) -> list[str]:
    both = [trial for trial in trials if all(trial.has(sensor) for sensor in SENSORS)]
    ratios = {
        trial.name: torque_over_twist(
            trial["base_angle_deg"],
            trial["tip_angle_deg"],
            trial["base_torque_n_mm"],
            stiffest_n_mm_per_rad(trial, rigidity_n_mm2),
        )
        for trial in both
    }
    high = {name: ratio for name, ratio in ratios.items() if ratio > TORQUE_OVER_TWIST}
    if not high:
        return []
    worst = max(high, key=lambda name: high[name])
    return [
        f"{_listed(high)}: base_torque_n_mm is up to {high[worst]:.3g} times what twists the nominal "
        f"needle from base_angle_deg to tip_angle_deg ({worst}); check units and order of the three, "
        "and diameter_mm and shear_modulus_gpa in rig.yaml"
    ]


def _other_angle_units(trial: Trial, noise: Mapping[str, float]) -> list[str]:
    """The tip turns as the base does in other units: far more, or far less, noise and all."""
    turned = float(np.ptp(trial["base_angle_deg"]))
    if not trial.has("tip_angle_deg") or turned < max(1.0, 20 * noise["base_angle_deg"]):
        return []
    tip = trial["tip_angle_deg"]
    ratio = float(np.nanmax(tip) - np.nanmin(tip)) / turned
    quiet = scatter(tip) < 0.1 * noise["tip_angle_deg"]
    if _LESS_THAN_DEG < ratio < _MORE_THAN_DEG or (ratio < 1 and not quiet):
        return []
    return [
        f"{trial.name}: tip_angle_deg turns {ratio:.3g} times as far as base_angle_deg; "
        "is one of the two in radians? then multiply it by 57.2958"
    ]


def _coarse(name: str, having: Sequence[Trial], claim: float) -> list[str]:
    """Rounding to steps of q is a noise of q / sqrt(12) by itself."""
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
            found.append(f"{_listed(without)}: no reading of {sensor}; the other signals are used there")
    return found


def _not_at_rest(trials: Sequence[Trial], noise: Mapping[str, float]) -> list[str]:
    """The start of every trial is untwisted: the tip where the base is, and no torque."""
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
                f"{_listed(off)}: {sensor} starts away from {meant} (by {off[first]:.3g} in {first}); "
                "a trial should start untwisted and at rest, but an offset of the sensor looks the same"
            )
    return warnings


def _offset(trial: Trial, sensor: str, noise: Mapping[str, float]) -> float:
    """Mean of the first readings off rest, while the base has not moved; 0 within the noise."""
    base = trial["base_angle_deg"][:_REST_SAMPLES]
    still = np.abs(base - base[0]) <= _STILL * noise["base_angle_deg"]
    first = slice(0, int(np.argmin(still)) if not still.all() else base.size)
    read = trial[sensor][first] - (trial["base_angle_deg"][first] if sensor == "tip_angle_deg" else 0.0)
    read = read[np.isfinite(read)]
    one = np.nanmax([noise[sensor], scatter(trial[sensor]), 0.0])
    if read.size == 0 or not one > 0 or abs(read.mean()) <= _REST * one / np.sqrt(read.size):
        return 0.0
    return float(read.mean())


def _listed(names: Mapping[str, float] | Sequence[str]) -> str:
    shown = list(names)[:4]
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")
