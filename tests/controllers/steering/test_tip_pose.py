"""The pose of the tip: its Jacobians against finite differences, its corrections against rotations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from controllers.steering.tip_pose import TipPose, cross_matrix

RADIUS_MM, TRAVEL_MM, ROLL_RAD = 61.0, 0.5, 0.7
SMALL = 1e-4


def pose(position=(0, 0, 0), direction=(0, 0, 0)):
    """A pose that went round a bend, off by an error."""
    made = TipPose(RADIUS_MM)
    made.advance(30.0, 0.4)
    made.correct(np.array(position, float), np.array(direction, float))
    return made


def errors_after(*, position=(0, 0, 0), direction=(0, 0, 0), roll=0.0):
    """Error state after a step, per unit of the one before it."""
    estimated, true = pose(), pose(position, direction)
    estimated.advance(TRAVEL_MM, ROLL_RAD)
    true.advance(TRAVEL_MM, ROLL_RAD + roll)
    return [e / SMALL for e in estimated.errors_to(true.position_mm, true.frame)]


@pytest.mark.parametrize("axis", range(3))
def test_an_error_of_the_direction_grows_into_one_of_the_position(axis):
    jacobian = pose().advance(TRAVEL_MM, ROLL_RAD)
    position, direction = errors_after(direction=SMALL * np.eye(3)[axis])
    # A finite rotation leaves second-order terms: half of SMALL, times the travel.
    assert position == pytest.approx(jacobian.direction_on_position[:, axis], abs=SMALL)
    assert direction == pytest.approx(np.eye(3)[axis], abs=SMALL)


@pytest.mark.parametrize("axis", range(3))
def test_an_error_of_the_position_stays_what_it_is(axis):
    position, direction = errors_after(position=SMALL * np.eye(3)[axis])
    assert position == pytest.approx(np.eye(3)[axis], abs=1e-9)
    assert direction == pytest.approx(np.zeros(3), abs=1e-9)


def test_an_error_of_the_roll_bends_the_path_as_the_jacobian_says():
    jacobian = pose().advance(TRAVEL_MM, ROLL_RAD)
    position, direction = errors_after(roll=SMALL)
    angle = TRAVEL_MM / RADIUS_MM
    assert np.linalg.norm(jacobian.roll_on_direction) == pytest.approx(angle)
    # To first order of the angle of the step: what is left out is half of its square.
    assert direction == pytest.approx(jacobian.roll_on_direction, abs=angle**2)
    assert position == pytest.approx(jacobian.roll_on_position, abs=TRAVEL_MM * angle**2)


def test_a_correction_is_the_error_that_it_takes_away():
    estimated, true = pose(), pose((0.2, -0.1, 0.3), (0.02, 0.05, -0.04))
    estimated.correct(*estimated.errors_to(true.position_mm, true.frame))
    assert estimated.position_mm == pytest.approx(true.position_mm)
    assert estimated.frame == pytest.approx(true.frame)
    turned = Rotation.from_rotvec([0.02, 0.05, -0.04]).as_matrix() @ pose().frame
    assert true.frame == pytest.approx(turned)


def test_the_cross_matrix_is_the_cross_product():
    a, b = np.array([1.0, -2.0, 0.5]), np.array([0.3, 0.1, 4.0])
    assert cross_matrix(a) @ b == pytest.approx(np.cross(a, b))
