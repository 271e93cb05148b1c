"""A small study of steering, which several tests read."""

import math

import pytest

from studies.control.steering.duty_cycle_study import SpunCurvature
from studies.control.steering.fused_study import RollErrors
from studies.control.steering.planar_study import PLANAR_CASES, approach_plane, imaged_approaches
from studies.control.steering.seed_spread import Spread
from studies.control.steering.steered_insertions import TurnOrder, steered_insertions
from studies.control.steering.steering_study import SteeringStudy


@pytest.fixture(scope="session")
def small_steering():
    """Baselines only, and 20 mm of travel: too short to come into the plane."""
    return SteeringStudy(
        steered={order: steered_insertions(order, controllers=()) for order in TurnOrder},
        known_pose={10.0: approach_plane(cases=tuple(PLANAR_CASES)[:1], travel_mm=20.0)},
        imaged={10.0: imaged_approaches(cases=tuple(PLANAR_CASES)[:1], travel_mm=20.0, seeds=(1, 2))},
        fused={"plant": {"base alone": RollErrors(rms_deg=_spread(2.0), end_deg=_spread(3.0))}},
        spun=[SpunCurvature(case="any", start_mm=20.0, duty=0.75, share=0.01, direction_deg=math.nan)],
    )


def _spread(median):
    return Spread(median=median, least=0.5 * median, largest=2 * median)
