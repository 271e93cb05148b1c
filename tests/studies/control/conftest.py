"""A small study of steering, which several tests read."""

import pytest

from studies.control.steering.planar_study import PLANAR_CASES, approach_plane, imaged_approaches
from studies.control.steering.steered_insertions import TurnOrder, steered_insertions
from studies.control.steering.steering_study import SteeringStudy


@pytest.fixture(scope="session")
def small_steering():
    """Baselines only, and 20 mm of travel: too short to come into the plane."""
    return SteeringStudy(
        steered={order: steered_insertions(order, controllers=()) for order in TurnOrder},
        known_pose={10.0: approach_plane(cases=tuple(PLANAR_CASES)[:1], travel_mm=20.0)},
        imaged={10.0: imaged_approaches(cases=tuple(PLANAR_CASES)[:1], travel_mm=20.0, seeds=(1, 2))},
    )
