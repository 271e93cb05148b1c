"""Reports against sealed answers: what was said, what was so.

A report is exact if its verdict and its set of effects are those of the answer. Where
stiffness or damping are off by up to 3 % beside an effect, they may be named or not. Where
the laws themselves leave it open, and an oracle that knows them could not decide
either, exact is `undecided` with the truth among what cannot be told apart.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from diagnosis.effects import LIBRARY

# The same law where the needle never slides.
TWINS = {"coulomb_friction", "speed_dependent_friction"}
# Without the base torque only their ratio shows.
OFF_NOMINAL = {"stiffness_error", "damping_error"}
A_LITTLE = 0.03  # no rig is nearer to its nominal constants


def read_scores(folder: Path, trials: int | None = None) -> pd.DataFrame:
    """One row a log: answer, report and whether they agree; index: the case.

    Args:
      trials: that the reports are of; None: all.
    """
    answers = json.loads((folder / "answers" / "answers.json").read_text())
    rows = {}
    for case, answer in answers.items():
        path = reports_in(folder, trials) / f"{case}.json"
        if path.exists():
            rows[case] = _row(answer, json.loads(path.read_text()), trials)
    return pd.DataFrame.from_dict(rows, orient="index")


def reports_in(folder: Path, trials: int | None = None) -> Path:
    """Where reports on all, or on the first few, trials of every log are."""
    return folder / ("reports" if trials is None else f"reports_of_{trials}")


def _row(answer: dict[str, Any], report: dict[str, Any], trials: int | None) -> dict[str, Any]:
    truth, said = set(answer["effects"]), set(report["effects"])
    free = _free(answer, truth)
    confused = report["verdict"] == "undecided" and any(
        set(names) - free == truth - free for names in report.get("confusable", [])
    )
    open_ = _is_open(answer, trials)
    ranking = {r["effect"]: r["probability"] for r in report.get("ranking", [])}
    top = max(ranking, key=lambda name: ranking[name]) if ranking else ""
    right = truth or ({"none"} if answer["verdict"] == "none" else {"unknown"})
    inside = [_inside(answer, report, effect, name) for effect, name in _parameters(answer)]
    known = [x for x in inside if x is not None]
    return {
        "kind": answer.get("kind", _kind(answer)),
        "truth": " + ".join(sorted(truth)) or answer["verdict"],
        "said": " + ".join(sorted(said)) or report["verdict"],
        "verdict": report["verdict"],
        "expected": answer["verdict"],
        "exact": confused
        if open_
        else (report["verdict"] == answer["verdict"] and said - free == truth - free),
        "confused": confused,
        "open": open_,
        "signature": min(answer.get("signature", {}).values(), default=np.nan),
        "over_hidden": _over_hidden(answer, report),
        "top": top,
        "probability": ranking.get(top, np.nan),
        "top_right": top in right,
        "probability_right": sum(ranking.get(name, 0.0) for name in right),
        "inside": sum(known),
        "intervals": len(known),
        "gap_before": report.get("gap", {}).get("before", np.nan),
        "gap_after": report.get("gap", {}).get("after", np.nan),
        "seconds": report.get("seconds", np.nan),
    }


def _free(answer: dict[str, Any], truth: set[str]) -> set[str]:
    """What may be named or not: stiffness and damping that are a little off beside an effect."""
    scales = {n: p["scale"] for n, p in answer["parameters"].items() if n in OFF_NOMINAL}
    return {
        name
        for name, scale in scales.items()
        if name not in truth or (len(truth) > 1 and abs(scale - 1.0) <= A_LITTLE)
    }


def _over_hidden(answer: dict[str, Any], report: dict[str, Any]) -> float:
    """Strength of the one true effect over what the report says may hide; NaN: it does not say."""
    if len(answer["effects"]) != 1:
        return float("nan")
    effect = answer["effects"][0]
    first = LIBRARY[effect].parameters[0]
    most = report.get("hidden", {}).get(effect, {}).get(first.name)
    if most is None:
        return float("nan")
    return first.strength(answer["parameters"][effect][first.name]) / first.strength(most)


def _is_open(answer: dict[str, Any], trials: int | None) -> bool:
    """Whether no trial can tell the true effect from its twin."""
    details, truth = answer.get("details", {}), set(answer["effects"])
    seen = details.get("trials", [{"sliding": True}])[:trials]
    at_rest = not any(trial["sliding"] for trial in seen)
    without_torque = details.get("missing") == "base_torque_n_mm"
    return (bool(TWINS & truth) and at_rest) or (bool(OFF_NOMINAL & truth) and without_torque)


def _kind(answer: dict[str, Any]) -> str:
    verdict = str(answer["verdict"])
    if verdict != "explained":
        return {"none": "none", "unknown": "outside"}.get(verdict, verdict)
    return "single" if len(answer["effects"]) == 1 else "pair"


def _parameters(answer: dict[str, Any]) -> list[tuple[str, str]]:
    return [(e, name) for e, own in answer["parameters"].items() if e in LIBRARY for name in own]


def _inside(answer: dict[str, Any], report: dict[str, Any], effect: str, name: str) -> bool | None:
    """Whether an interval covers; None where the report has none, or explains otherwise."""
    found = report.get("parameters", {}).get(effect, {}).get(name)
    if found is None or not set(answer["effects"]) <= set(report["effects"]):
        return None
    return bool(found["low"] <= answer["parameters"][effect][name] <= found["high"])
