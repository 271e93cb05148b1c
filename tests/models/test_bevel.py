"""The path of a bevel tip: circles, straight lines, and what does not change along the way."""

import math

import numpy as np
import pytest

from models.bevel import PREBENT_RADIUS_MM, BevelTip, path_mm
from models.errors import InvalidValue


def test_a_tip_that_does_not_roll_follows_a_circle():
    arc = np.linspace(0, 61 * math.pi / 2, 400)
    end = path_mm(arc, np.zeros(400))[-1]
    assert end == pytest.approx([61, 61, 0], abs=1e-9)


def test_a_tip_that_spins_goes_straight():
    arc = np.linspace(0, 20, 2001)
    end = path_mm(arc, 50 * arc)[-1]
    # 50 rad/mm bend the mean direction by 1 / (61 50): 0.0066 mm aside in 20 mm.
    assert np.linalg.norm(end - [20, 0, 0]) == pytest.approx(20 / (61 * 50), rel=0.05)


def test_the_roll_turns_the_plane_of_the_circle():
    arc = np.linspace(0, 61 * math.pi / 2, 400)
    end = path_mm(arc, np.full(400, math.pi / 2))[-1]
    assert end == pytest.approx([61, 0, 61], abs=1e-9)


def test_going_back_retraces_the_arc():
    tip = BevelTip()
    for length in (7.0, -7.0):
        tip.advance(length, 0.4)
    assert tip.position_mm == pytest.approx(np.zeros(3), abs=1e-12)
    assert tip.tangent == pytest.approx([1, 0, 0])


def test_the_frame_stays_orthonormal():
    tip = BevelTip(PREBENT_RADIUS_MM, (0.0, 0.0, 3.0))
    for k in range(200):
        tip.advance(0.7, 0.3 * k)
    pull, onward = tip.pointing(1.1)
    basis = np.array([tip.tangent, pull, onward])
    assert basis @ basis.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(basis) == pytest.approx(1.0)


@pytest.mark.parametrize("radius", [0.0, -1.0, math.nan])
def test_an_impossible_radius_is_refused(radius):
    with pytest.raises(InvalidValue, match="radius_mm"):
        BevelTip(radius)
