"""The ground truth of a log, as it stands in answers.json."""

from typing import Any

import numpy as np

from validation.logs.case import ValidationCase
from validation.rig.motion import TrialMotion

Answer = dict[str, Any]
VERDICTS = {"none": "none", "rough_none": "none", "outside": "unknown"}
"""Verdict that is right for a kind; `explained` for all others."""


def ground_truth(kind: str, case: ValidationCase) -> Answer:
    """The entry of answers.json: verdict, effects and parameters, signatures, gap, details."""
    signatures = dict(sorted(case.signatures.items(), key=lambda item: -item[1]))
    answer: Answer = {
        "verdict": VERDICTS.get(kind, "explained"),
        "effects": [name for name in signatures if name in case.rig.effects],
        "parameters": {name: dict(p) for name, p in {**case.rig.effects, **case.rig.outside}.items()},
        "kind": kind,
        "signature": {name: round(value, 3) for name, value in signatures.items()},
        "gap": round(case.gap, 3),
    }
    if case.rig.outside:
        answer["outside"] = next(iter(case.rig.outside))
    if case.roughness:
        answer["roughness"] = {one.name: dict(one.numbers) for one in case.roughness}
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


def _trial(motion: TrialMotion) -> dict[str, Any]:
    return {
        "duration_s": round(float(motion.time_s[-1] - motion.time_s[motion.lead]), 2),
        "depth_mm": [round(float(depth), 1) for depth in motion.inserted_mm[[motion.lead, -1]]],
        "sliding": bool(np.any(motion.speed_mm_s[motion.lead :])),
        "growing": motion.growing,
        "loaded": motion.tip_torque_n_mm is not None,
    }
