"""The score as JSON: the figures that `needle blind score` prints, for programs."""

from typing import Any

import pandas as pd

from validation.score import calibration
from validation.score.missing import missing_summary


def as_json(scores: pd.DataFrame) -> dict[str, Any]:
    """Figures by kind, calibration, and results on unmodelled effects; None if there are none.

    `scores` as from `read_scores`. The values of `missing` are pairs: how many, of how many.
    """
    share, count = calibration.coverage(scores)
    return {
        "format": "blind-score/1",
        "logs": len(scores),
        "kinds": {
            str(kind): {str(name): _number(value) for name, value in row.items()}
            for kind, row in calibration.summary(scores).iterrows()
        },
        "calibration_error": _number(calibration.calibration_error(scores)),
        "calibration_error_by_chance": _number(calibration.calibration_error_by_chance(scores)),
        "intervals": {"count": count, "inside": _number(share)},
        "gap_left": _number(calibration.gap_left(scores)),
        "missing": {name: [*pair] for name, pair in missing_summary(scores).items()},
    }


def _number(value: float) -> float | None:
    return None if pd.isna(value) else float(value)
