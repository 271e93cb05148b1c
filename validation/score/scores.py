"""Compares reports of the diagnosis with the ground truth, in a table with one row per log."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from diagnosis.effects import LIBRARY
from models.errors import InvalidValue
from validation.score.answers import FILE, read_answers
from validation.score.correctness import correctness, optional_effects
from validation.score.missing import missing_scores


def read_scores(folder: Path, trials: int | None = None, limit_s: float | None = None) -> pd.DataFrame:
    """One row per log that has a report; index: the case, the name of the log's folder.

    Args:
      trials: number of trials that the reports are based on; None: all.
      limit_s: time limit of each diagnosis, s; None: no limit.

    Raises:
      InvalidValue: the ground truth is unusable, or belongs to none of the logs.
    """
    answers, reports = read_answers(folder), reports_in(folder, trials, limit_s)
    rows = {
        case: _row(answer, json.loads((reports / f"{case}.json").read_text()), trials)
        for case, answer in answers.items()
        if (reports / f"{case}.json").exists()
    }
    if not rows:
        expected = f"entries named like the logs, which have reports in {reports}"
        raise InvalidValue(str(folder / FILE), [*answers], expected)
    return pd.DataFrame.from_dict(rows, orient="index")


def reports_in(folder: Path, trials: int | None = None, limit_s: float | None = None) -> Path:
    """Folder of the reports for these numbers of trials and this time limit."""
    few = "" if trials is None else f"_of_{trials}"
    return folder / f"reports{few}{'' if limit_s is None else f'_in_{limit_s:g}_s'}"


def _row(answer: dict[str, Any], report: dict[str, Any], trials: int | None) -> dict[str, Any]:
    true, diagnosed = set(answer["effects"]), set(report["effects"])
    compared = correctness(answer, report, trials)
    ranking = report.get("ranking", [])
    first = max(ranking, key=lambda row: row["probability"]) if ranking else None
    right_rows = [row for row in ranking if _is_right(answer, row)]
    right = " + ".join(sorted(true)) or answer["verdict"]
    inside = [_inside(answer, report, effect, name) for effect, name in _parameters(answer)]
    known = [x for x in inside if x is not None]
    return {
        "kind": answer.get("kind", _kind(answer)),
        "truth": right,
        "said": " + ".join(sorted(diagnosed)) or report["verdict"],
        "verdict": report["verdict"],
        "expected": answer["verdict"],
        "exact": compared.exact,
        "confidently_wrong": compared.confidently_wrong,
        "confused": compared.confused,
        "open": compared.undecidable,
        "signature": min(answer.get("signature", {}).values(), default=np.nan),
        "over_hidden": _over_limit(answer, report),
        "top": first["effect"] if first else "",
        "probability": first["probability"] if first else np.nan,
        "top_right": first in right_rows,
        "probability_right": sum((row["probability"] for row in right_rows), 0.0),
        "inside": sum(known),
        "intervals": len(known),
        "gap_before": report.get("gap", {}).get("before", np.nan),
        "gap_after": report.get("gap", {}).get("after", np.nan),
        "seconds": report.get("seconds", np.nan),
        **missing_scores(answer, report),
    }


def _over_limit(answer: dict[str, Any], report: dict[str, Any]) -> float:
    """Strength of the one true effect / its reported detection limit; NaN if none is reported."""
    if len(answer["effects"]) != 1 or answer["effects"][0] not in LIBRARY:
        return float("nan")
    effect = answer["effects"][0]
    first = LIBRARY[effect].parameters[0]
    limit = report.get("hidden", {}).get(effect, {}).get(first.name)
    strength = answer["parameters"].get(effect, {}).get(first.name)
    if limit is None or strength is None:
        return float("nan")
    true = first.distance_from_neutral(strength)
    return true / first.distance_from_neutral(limit)


def _is_right(answer: dict[str, Any], row: dict[str, Any]) -> bool:
    """Whether a row of the ranking names the true effects, or as many that no log can tell from them;
    what is optional may be there or not.
    """
    true = set(answer["effects"])
    if not true:
        return bool(row["effect"] == answer["verdict"])
    optional = optional_effects(answer)
    named = set(row.get("effects", row["effect"].split(" + ")))
    equal = (set(names) for names in answer.get("acceptable", []) if len(names) == len(true))
    return any(named - optional == names - optional for names in (true, *equal))


def _kind(answer: dict[str, Any]) -> str:
    verdict = str(answer["verdict"])
    if verdict != "explained":
        return {"none": "none", "unknown": "outside"}.get(verdict, verdict)
    return "single" if len(answer["effects"]) == 1 else "pair"


def _parameters(answer: dict[str, Any]) -> list[tuple[str, str]]:
    return [(e, name) for e, own in answer["parameters"].items() if e in LIBRARY for name in own]


def _inside(answer: dict[str, Any], report: dict[str, Any], effect: str, name: str) -> bool | None:
    """Whether an interval contains the true value; None without one, or if other effects are named."""
    interval = report.get("parameters", {}).get(effect, {}).get(name)
    if interval is None or not set(answer["effects"]) <= set(report["effects"]):
        return None
    true = answer["parameters"][effect][name]
    period = next(p.period for p in LIBRARY[effect].parameters if p.name == name)
    if period:  # an angle: the turn that is nearest to the reported one
        true += period * round((interval["value"] - true) / period)
    return bool(interval["low"] <= true <= interval["high"])
