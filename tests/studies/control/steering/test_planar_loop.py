"""The planar controller around a tip controller: what it is told of the tip."""

import math

import numpy as np
import pytest

from controllers.steering.planar_observer import PlanarObserver
from models.bevel import BevelTip
from sim.closed_loop import Measurement
from studies.control.steering.camera import Camera, CameraModel
from studies.control.steering.planar_loop import CascadedPlanarController, ImagedHeight, KnownPose

RADIUS_MM = 61.0


def measurement(time_s, inserted_mm, tip_deg=0.0):
    return Measurement(
        time_s=time_s,
        base_deg=0.0,
        torque_n_mm=0.0,
        tip_deg=tip_deg,
        inserted_mm=inserted_mm,
        free_mm=50.0,
    )


def test_the_known_pose_is_that_of_the_tip_with_the_roll_as_it_is_believed():
    tip = BevelTip(RADIUS_MM, (0, 0, 2.0))
    tip.advance(10.0, 0.5)
    state = KnownPose().update(tip, 0.0, 0.0, 0.9)
    toward, onward = tip.pointing(0.9)
    assert (state.height_mm, state.slope) == (tip.position_mm[2], tip.tangent[2])
    assert (state.pull, state.facing) == (toward[2], onward[2])


def test_with_perfect_images_the_state_becomes_that_of_the_tip():
    camera = Camera(CameraModel(noise_mm=0, delay_s=0.1), seed=1)
    known = ImagedHeight(camera, PlanarObserver(radius_mm=RADIUS_MM, settling_mm=5.0))
    tip = BevelTip(RADIUS_MM, (0, 0, 2.0))
    tip.advance(5.0, math.pi / 2)  # climbs by 5 / 61 rad, which the observer does not know
    for i in range(800):
        tip.advance(0.05, 0.3)
        state = known.update(tip, 0.01 * i, 0.05, 0.3)
    expected = [tip.position_mm[2], tip.tangent[2], tip.pointing(0.3)[0][2]]
    # 40 mm are eight settling lengths: (1 + 8 + 32) exp(-8) of the error of 0.08 at the start.
    assert [state.height_mm, state.slope, state.pull] == pytest.approx(expected, abs=0.03)


def test_a_rigid_needle_comes_into_the_plane_and_its_heights_are_kept():
    planar = CascadedPlanarController(None, KnownPose(), height_mm=2.0)
    for i in range(2000):
        base_deg = planar(measurement(0.005 * i, 100 + 0.05 * i), 0.0)
    assert len(planar.heights_mm) == 2000
    assert planar.heights_mm[0] == 2.0
    assert np.abs(planar.heights_mm[-200:]).max() < 0.05
    assert base_deg != 0.0
    assert planar.advance_mm == 0.0
