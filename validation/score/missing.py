"""Whether a report of `unknown` is right about what is missing: its place, and what it depends on.

This counts logs whose ground truth is `unknown` and names both. The place is right if the likeliest
one is among the true ones, the variable if the first one is; a law closes the gap if it leaves at most
`CLOSED` sigma on trials that its fit has not seen. Reports on other logs should name nothing missing.
"""

from collections.abc import Mapping
from typing import Any

import pandas as pd

CLOSED = 1.1
"""Residual / sigma that a free-form law may leave on trials that its fit has not seen."""
ELSEWHERE_GOAL = 0.01
"""Share of reports on logs that the library explains which may say that something is missing."""


def missing_scores(answer: Mapping[str, Any], report: Mapping[str, Any]) -> dict[str, Any]:
    """Columns of one log; empty text and False if the report says nothing.

    Returns:
      outside: the true effect; missing_told: whether the ground truth says what is missing;
      missing_said: whether the report does; missing_place, missing_variable: its first answer, and
      whether that is right; missing_gap: residual / sigma with its first law; missing_closed.
    """
    told = answer.get("missing", {"place": [], "variables": []})
    said = report.get("missing") or {}
    places, variables = said.get("place") or {}, said.get("depends_on") or []
    place = max(places, key=lambda name: places[name], default="")
    variable = variables[0]["variable"] if variables else ""
    gap = variables[0].get("gap_after") if variables else None
    return {
        "outside": answer.get("outside", ""),
        "missing_told": "missing" in answer,
        "missing_said": bool(said),
        "missing_place": place,
        "missing_place_right": place in told["place"],
        "missing_variable": variable,
        "missing_variable_right": variable in told["variables"],
        "missing_gap": float("nan") if gap is None else float(gap),
        "missing_closed": "missing" in answer and gap is not None and gap <= CLOSED,
    }


def missing_summary(scores: pd.DataFrame) -> dict[str, tuple[int, int]]:
    """Counts by what is counted: how many, of how many; `scores` as from `read_scores`.

    Among logs whose ground truth is `unknown` and says what is missing: reports that say so, too, and
    how many of these are right. Among logs whose ground truth is `none` or `explained`: reports that
    name something missing.
    """
    beyond = scores[(scores["expected"] == "unknown") & scores["missing_told"]]
    said = beyond[beyond["missing_said"]]
    known = scores[scores["expected"].isin(["none", "explained"])]
    return {
        "said": (len(said), len(beyond)),
        "place_right": (int(said["missing_place_right"].sum()), len(said)),
        "variable_right": (int(said["missing_variable_right"].sum()), len(said)),
        "closed": (int(said["missing_closed"].sum()), len(said)),
        "elsewhere": (int(known["missing_said"].sum()), len(known)),
    }
