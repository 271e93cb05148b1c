"""Recordings of step responses: Tables IV and V at 10 cm, and the best and worst on every rig."""

import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from sim.recording.recording import Recording
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.comparison import SAME_LIMITS, SLOW_BASELINE, StepResponse
from studies.control.robustness import plants
from studies.control.step_response import ControlPlant, step_on
from studies.control.tables import CONTROLLERS

DEPTH_CM, FREE_MM = 10.0, 50.0
_SHOWN_S, _ROBUST_SHOWN_S = 2.0, 3.0


@dataclass(frozen=True, kw_only=True)
class StepRecording:
    """A recording to make: the stem of its file, what it shows in words, and how to simulate it."""

    stem: str
    results: tuple[str, ...]
    make: Callable[[], Recording]


def stems() -> list[str]:
    """Stems of all files that `step_recordings` describes."""
    tables = [f"turn_{name}" for name in CONTROLLERS]
    return tables + [f"robust_{_slug(name)}_{end}" for name in plants() for end in ("best", "worst")]


def step_recordings(
    tables: Iterable[StepResponse], robustness: Iterable[StepResponse]
) -> list[StepRecording]:
    """The turns of Tables IV and V at 10 cm, 50 mm free; then best and worst on each rig."""
    at_10_cm = [r for r in tables if (r.depth_cm, r.free_mm) == (DEPTH_CM, FREE_MM)]
    made = [
        _recorded(f"turn_{r.controller}", r, ControlPlant(name=r.plant), _SHOWN_S)
        for r in at_10_cm
        if r.controller in CONTROLLERS
    ]
    responses = list(robustness)
    for name, plant in plants().items():
        found = [
            r for r in responses if r.plant == name and r.controller not in (SLOW_BASELINE, SAME_LIMITS)
        ]
        if found:
            ranked = sorted(found, key=_badness)
            for end, response in (("best", ranked[0]), ("worst", ranked[-1])):
                stem = f"robust_{_slug(name)}_{end}"
                made.append(_recorded(stem, response, plant, _ROBUST_SHOWN_S))
    return made


def _badness(response: StepResponse) -> tuple[bool, int, float]:
    """Sort key: never settled, then number of failures, then settling time."""
    never = math.isnan(response.settle_s)
    late = response.final_error_deg if never else response.settle_s
    return never, len(response.failures), late


def _slug(name: str) -> str:
    return re.sub(r"[^a-z0-9.]+", "-", name.lower()).strip("-")


def _recorded(stem: str, response: StepResponse, plant: ControlPlant, hold_s: float) -> StepRecording:
    def make() -> Recording:
        controlled = step_on(
            plant,
            response.controller,
            depth_cm=response.depth_cm,
            free_mm=response.free_mm,
            hold_s=hold_s,
            keep_shape=True,
        )
        about = {
            "protocol": f"step of 90 deg, {response.controller}",
            "description": f"{response.depth_cm:g} cm deep, rig: {plant.name}",
            "controller": response.controller,
            "plant": plant.name,
            "hardware": plant.hardware.model_dump(mode="json"),
        }
        return record_closed_loop(controlled, about)

    settled = (
        "never settles" if math.isnan(response.settle_s) else f"settles in {response.settle_s:.2f} s"
    )
    results = (
        f"{settled}, overshoot {response.overshoot_deg:.1f} deg",
        f"largest shear stress {response.shear_stress_mpa:.0f} MPa",
        *(f"failed: {words}" for words in response.failures),
    )
    return StepRecording(stem=stem, results=results, make=make)
