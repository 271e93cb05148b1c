"""The score as JSON: the same figures, and no number where there is none."""

import json

import numpy as np
import pandas as pd

from validation.score.calibration import calibration_error, calibration_error_by_chance, summary
from validation.score.json_summary import as_json
from validation.score.missing import missing_summary

ROW = {
    "kind": "outside",
    "verdict": "unknown",
    "expected": "unknown",
    "exact": True,
    "confidently_wrong": False,
    "seconds": 3.0,
    "inside": 0,
    "intervals": 0,
    "probability": 0.9,
    "probability_right": 0.9,
    "top_right": True,
    "gap_after": np.nan,
    "missing_told": True,
    "missing_said": True,
    "missing_place_right": True,
    "missing_variable_right": False,
    "missing_closed": True,
}


def test_the_figures_are_those_of_the_tables():
    scores = pd.DataFrame([ROW, ROW | {"exact": False, "seconds": 5.0}])
    found = json.loads(json.dumps(as_json(scores), allow_nan=False))
    assert found["format"] == "blind-score/1"
    assert found["logs"] == 2
    assert found["kinds"] == {"outside": summary(scores).loc["outside"].to_dict()}
    assert found["calibration_error_by_chance"] == calibration_error_by_chance(scores)
    assert found["calibration_error"] == calibration_error(scores)
    assert found["intervals"] == {"count": 0, "inside": None}
    assert found["gap_left"] is None
    assert found["missing"] == {name: [*pair] for name, pair in missing_summary(scores).items()}
