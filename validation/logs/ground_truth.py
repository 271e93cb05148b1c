"""The ground truth of a log, as an entry of answers.json."""

from typing import Any

import numpy as np

from validation.logs.case import ValidationCase
from validation.logs.equivalents import acceptable, as_effects
from validation.rig.motion import TrialMotion
from validation.rig.unmodelled.library import EFFECTS, UNLISTED_CONSTANTS

Answer = dict[str, Any]
VERDICTS = {"none": "none", "rough_none": "none", "outside": "unknown"}
"""Verdict that is right for a kind; `explained` for all others, and for wrong constants as they are."""


def ground_truth(kind: str, case: ValidationCase) -> Answer:
    """The entry of answers.json: verdict, effects and parameters, signatures, gap, details."""
    signatures = dict(sorted(case.signatures.items(), key=lambda item: -item[1]))
    known_as = as_effects(case.rig)
    parameters = {**case.rig.effects, **case.rig.outside, **known_as}
    answer: Answer = {
        "verdict": VERDICTS.get(kind, "explained"),
        "effects": [*(name for name in signatures if name in case.rig.effects), *known_as],
        "parameters": {name: dict(p) for name, p in parameters.items()},
        "kind": kind,
        "signature": {name: round(value, 3) for name, value in signatures.items()},
    }
    if case.signatures or kind in VERDICTS:
        answer["gap"] = round(case.gap, 3)
    if case.rig.outside:
        answer["outside"] = next(iter(case.rig.outside))
    others = acceptable(
        answer["effects"], loaded=any(m.tip_torque_n_mm is not None for m in case.motions)
    )
    if others:
        answer["acceptable"] = others
    if kind == "wrong_outside":
        answer |= _wrong_outside(case)
    elif case.roughness:
        answer["roughness"] = {one.name: dict(one.numbers) for one in case.roughness}
    if answer["verdict"] == "unknown" and case.rig.outside:
        answer["missing"] = _missing(answer["outside"])
    if case.alternatives.alone:
        best = dict(list(case.alternatives.alone.items())[:3])
        answer["rivals"] = {name: round(value, 3) for name, value in best.items()}
        answer["rival_pair"] = [*case.alternatives.pair, round(case.alternatives.pair_residual, 3)]
    trials = [_trial(motion) for motion in case.motions]
    answer["details"] = {
        **case.sensors.details(),
        "rate_hz": case.plan.rate_hz,
        "growing": any(trial["growing"] for trial in trials),
        "trials": trials,
    }
    return answer


def _wrong_outside(case: ValidationCase) -> Answer:
    """What the library does not have; a flipped sign may also be refused, with trial and column."""
    if not case.roughness:
        return {"verdict": "explained" if as_effects(case.rig) else "unknown"}
    fault = case.roughness[0]
    answer: Answer = {
        "verdict": "unknown",
        "outside": fault.name,
        "parameters": {fault.name: dict(fault.numbers)},
    }
    if fault.name == "flipped_sign":
        answer["refusal"] = [*fault.numbers.values()]
    return answer


def _missing(outside: str) -> dict[str, list[str]]:
    """Where the effect acts, and on what it depends: the leading variable, then equally right ones."""
    effect = (EFFECTS | UNLISTED_CONSTANTS)[outside]
    return {"place": [*effect.place], "variables": [*effect.variables]}


def _trial(motion: TrialMotion) -> dict[str, Any]:
    return {
        "duration_s": round(float(motion.time_s[-1] - motion.time_s[motion.lead]), 2),
        "depth_mm": [round(float(depth), 1) for depth in motion.inserted_mm[[motion.lead, -1]]],
        "sliding": bool(np.any(motion.speed_mm_s[motion.lead :])),
        "growing": motion.growing,
        "loaded": motion.tip_torque_n_mm is not None,
    }
