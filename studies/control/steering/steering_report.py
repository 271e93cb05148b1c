"""The part of `control.json` on steering, as plain values."""

import math
from dataclasses import asdict
from typing import Any

from studies.control.steering.planar_spread import PlanarSpread
from studies.control.steering.planar_study import PlaneApproach
from studies.control.steering.steered_insertions import PUBLISHED_MM
from studies.control.steering.steering_study import SteeringStudy


def steering_json(study: SteeringStudy) -> dict[str, Any]:
    """Keys of control.json; null stands for "never"."""
    return {
        "steered_mm": {
            order.value: {one.name: one.out_of_plane_mm for one in insertions}
            for order, insertions in study.steered.items()
        },
        "steered_published_mm": PUBLISHED_MM,
        "planar_mm": {
            _speed(speed): {p.name: _or_none(p.converged_mm()) for p in approaches}
            for speed, approaches in study.known_pose.items()
        },
        "planar": {
            _speed(speed): {name: _spread(approaches) for name, approaches in cases.items()}
            for speed, cases in study.imaged.items()
        },
        "fused": {
            plant: {name: asdict(errors) for name, errors in by_estimator.items()}
            for plant, by_estimator in study.fused.items()
        },
        "duty_cycle": [_plain(asdict(one) | {"law_share": 1.0 - one.duty}) for one in study.spun],
    }


def _speed(speed_mm_s: float) -> str:
    return f"{speed_mm_s:g} mm/s"


def _spread(approaches: list[PlaneApproach]) -> dict[str, Any]:
    spread = PlanarSpread.of(approaches)
    return {
        "converged_mm": _plain(asdict(spread.converged_mm)),
        "never": spread.never,
        "seeds": len(approaches),
        "rms_mm": _plain(asdict(spread.rms_mm)),
    }


def _plain(values: dict[str, Any]) -> dict[str, Any]:
    return {name: _or_none(value) for name, value in values.items()}


def _or_none(value: Any) -> Any:
    return None if isinstance(value, float) and math.isnan(value) else value
