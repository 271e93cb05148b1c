"""Plausibility of a log that can be used all the same: each finding is a warning of the report.

A clean log raises none. What raises one is used as it is, since it may be true: a
trial that does not start at rest reads like a sensor with an offset.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import (
    COMMON_PAUSES,
    LEAST_FREE_SHAFT_MM,
    LENGTH_SLACK,
    LENGTH_SLACK_MM,
    PAUSE_STEPS,
    PAUSE_STEPS_UNEVEN,
    REST_SAMPLES,
    REST_SIGMA,
    STILL_SIGMA,
    TIP_QUIET,
    TIP_TURNS_AT_LEAST,
    TIP_TURNS_AT_MOST,
    TORQUE_OVER_TWIST,
    TURN_LEAST_DEG,
    TURN_LEAST_SIGMA,
    UNEVEN_QUARTILES,
)
from diagnosis.log.sensor_faults import lines, quantum, scatter
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]


def plausibility_warnings(
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
    return rigidity_n_mm2 / max(float(trial["free_mm"].min()), LEAST_FREE_SHAFT_MM)


def _gaps(trial: Trial) -> list[str]:
    """Pauses of a log that otherwise samples often."""
    steps = np.diff(trial["time_s"])
    low, median, high = np.quantile(steps, [0.25, 0.5, 0.75])
    pauses = steps > (PAUSE_STEPS if high < UNEVEN_QUARTILES * low else PAUSE_STEPS_UNEVEN) * median
    if not pauses.any() or pauses.mean() > COMMON_PAUSES:
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
    slack = LENGTH_SLACK_MM + LENGTH_SLACK * max(np.ptp(travel), np.ptp(shrunk))
    if np.abs(shrunk - travel).max() <= slack:
        return []
    opposite = np.abs(shrunk + travel).max() <= slack
    fix = "speed_mm_s seems to have the wrong sign" if opposite else "check units and zero of both"
    end = int(np.argmax(np.abs(travel) + np.abs(shrunk)))
    return [
        f"{trial.name}: free_mm and speed_mm_s disagree: by line {end + 2} speed_mm_s adds up to "
        f"{travel[end]:.3g} mm into the tissue, and free_mm has changed by {-shrunk[end]:.3g} mm "
        f"instead of {-travel[end]:.3g}; {fix}; both are used as they are"
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
    if not trial.has("tip_angle_deg") or turned < max(
        TURN_LEAST_DEG, TURN_LEAST_SIGMA * noise["base_angle_deg"]
    ):
        return []
    tip = trial["tip_angle_deg"]
    ratio = float(np.nanmax(tip) - np.nanmin(tip)) / turned
    quiet = scatter(tip) < TIP_QUIET * noise["tip_angle_deg"]
    if TIP_TURNS_AT_LEAST < ratio < TIP_TURNS_AT_MOST or (ratio < 1 and not quiet):
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
    base = trial["base_angle_deg"][:REST_SAMPLES]
    still = np.abs(base - base[0]) <= STILL_SIGMA * noise["base_angle_deg"]
    first = slice(0, int(np.argmin(still)) if not still.all() else base.size)
    read = trial[sensor][first] - (trial["base_angle_deg"][first] if sensor == "tip_angle_deg" else 0.0)
    read = read[np.isfinite(read)]
    one = np.nanmax([noise[sensor], scatter(trial[sensor]), 0.0])
    if read.size == 0 or not one > 0 or abs(read.mean()) <= REST_SIGMA * one / np.sqrt(read.size):
        return 0.0
    return float(read.mean())


def _listed(names: Mapping[str, float] | Sequence[str]) -> str:
    shown = list(names)[:4]
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")
