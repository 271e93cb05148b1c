"""Impossible lengths: far shorter than any needle, or jumping faster than the shaft can move.

Lengths in metres in a column of millimetres are too short: needles of less than a metre have none of 1
or more. A shaft is many diameters long, in any unit.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.checks import LENGTH_SLACK, LENGTH_SLACK_MM, PAUSE_STEPS
from diagnosis.criteria.log import (
    LEAST_DEPTH_MM,
    LENGTH_HOLD_S,
    LENGTH_JUMP_MM,
    SHORTEST_SHAFT_DIAMETERS,
    SHORTEST_SHAFT_MM,
)
from diagnosis.log.checks.travel import travelled_mm
from diagnosis.log.checks.wording import lines
from diagnosis.log.trial import Trial, UnusableLog

Array = NDArray[np.float64]

LENGTHS = ("inserted_mm", "free_mm")


def refuse_impossible_lengths(path: Path, trial: Trial, diameter_mm: float) -> None:
    """Refuse lengths in metres, and lengths that jump.

    Raises:
      UnusableLog: names file, columns or lines, and the fix.
    """
    _refuse_metres(path, trial, diameter_mm)
    for column in LENGTHS:
        _refuse_jumps(path, trial, column)


def length_warnings(trial: Trial) -> list[str]:
    """Warnings about lengths that disagree with each other or with the axial speed."""
    disagreeing = [*_speed_and_free_length(trial), *_beyond_the_shaft(trial)]
    return [*_tiny_free_length(trial), *disagreeing]


def _refuse_metres(path: Path, trial: Trial, diameter_mm: float) -> None:
    deepest = float(trial["inserted_mm"].max())
    longest = float((trial["inserted_mm"] + trial["free_mm"]).max())
    if longest < min(SHORTEST_SHAFT_DIAMETERS * diameter_mm, SHORTEST_SHAFT_MM):
        raise UnusableLog(
            f"{path}: inserted_mm and free_mm together never exceed {longest:.3g} mm; expected a shaft "
            f"of at least {SHORTEST_SHAFT_DIAMETERS:g} times diameter_mm ({diameter_mm:g}) in "
            "rig.yaml; if both are in metres, multiply them by 1000"
        )
    if 0 < deepest < LEAST_DEPTH_MM:
        raise UnusableLog(
            f"{path}: inserted_mm never exceeds {deepest:.3g} mm; expected at least {LEAST_DEPTH_MM:g} "
            "mm somewhere in a trial; if it is in metres, multiply it by 1000; if the needle is "
            "outside of the tissue, write 0"
        )


def _refuse_jumps(path: Path, trial: Trial, column: str) -> None:
    """Refuse lengths that jump more than the axial speed allows; a stage may be read rarely."""
    steps, moved = np.diff(trial["time_s"]), np.abs(np.diff(trial[column]))
    fastest = float(np.abs(trial["speed_mm_s"]).max())
    allowed = LENGTH_JUMP_MM + fastest * np.maximum(steps, LENGTH_HOLD_S)
    jumps = (moved > allowed) & (steps <= PAUSE_STEPS * np.median(steps))
    if jumps.any():
        rows = np.concatenate(([False], jumps))
        raise UnusableLog(
            f"{path}: {column} jumps by up to {moved[jumps].max():.3g} mm from one sample to the next, "
            f"{lines(rows)}; expected a length that moves with speed_mm_s (at most {fastest:.3g} mm/s "
            "here); correct these rows, or make a trial of each depth"
        )


def _tiny_free_length(trial: Trial) -> list[str]:
    longest = float(trial["free_mm"].max())
    if not 0 < longest < LEAST_DEPTH_MM:
        return []
    return [
        f"{trial.name}: free_mm never exceeds {longest:.3g} mm; if it is in metres, multiply it by "
        "1000; if the tissue begins at the chuck, write 0"
    ]


def _speed_and_free_length(trial: Trial) -> list[str]:
    """Warnings if the free length does not shrink by the axial travel."""
    travel = travelled_mm(trial)
    shrunk = trial["free_mm"][0] - trial["free_mm"]
    slack = LENGTH_SLACK_MM + LENGTH_SLACK * max(np.ptp(travel), np.ptp(shrunk))
    if np.abs(shrunk - travel).max() <= slack:
        return []
    opposite = np.abs(shrunk + travel).max() <= slack
    fix = (
        "speed_mm_s seems to have the wrong sign"
        if opposite
        else "check units and zero of both, and the unit of time_s"
    )
    end = int(np.argmax(np.abs(travel) + np.abs(shrunk)))
    return [
        f"{trial.name}: free_mm and speed_mm_s disagree: by line {end + 2} speed_mm_s adds up to "
        f"{travel[end]:.3g} mm into the tissue, and free_mm has changed by {-shrunk[end]:.3g} mm "
        f"instead of {-travel[end]:.3g}; {fix}; both are used as they are"
    ]


def _beyond_the_shaft(trial: Trial) -> list[str]:
    """Warnings if the inserted length grows by more than the free length loses."""
    deeper = trial["inserted_mm"] - trial["inserted_mm"][0]
    given = np.maximum(trial["free_mm"][0] - trial["free_mm"], 0.0)
    end = int(np.argmax(deeper - given))
    if deeper[end] - given[end] <= LENGTH_SLACK_MM + LENGTH_SLACK * np.ptp(deeper):
        return []
    return [
        f"{trial.name}: inserted_mm grows by {deeper[end]:.3g} mm until line {end + 2}, and free_mm "
        f"gives {given[end]:.3g} mm of that; check units and zero of both; both are used as they are"
    ]
