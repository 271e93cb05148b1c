"""The pictures of steering show what they are given."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from studies.control.steering.planar_study import PlaneApproach
from studies.control.steering.steered_insertions import TurnOrder
from studies.control.steering.steering_figures import draw_planes, draw_steered


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_both_orders_of_half_turns_are_drawn_beside_the_published_heights(small_steering):
    figure = draw_steered(small_steering)
    above, fro, winding = figure.axes
    paths = small_steering.steered[TurnOrder.TO_AND_FRO]
    for line, one in zip(above.lines, paths, strict=True):
        assert np.array_equal(line.get_ydata(), one.path_mm[:, 1])
    published = [line.get_ydata()[0] for line in fro.lines[len(paths) :]]
    assert published == [12.0, 4.0]
    assert len(winding.lines) == len(paths)


def test_every_seed_has_its_line_in_the_panel_of_its_speed(small_steering):
    figure = draw_planes(small_steering)
    known, imaged = figure.axes
    assert isinstance(small_steering.known_pose[10.0][0], PlaneApproach)
    assert len(known.lines) == 1
    *drawn, median = [line.get_ydata() for line in imaged.lines]
    expected = [a.height_mm for a in small_steering.imaged[10.0]["its own simulation"]]
    assert all(np.array_equal(a, b) for a, b in zip(drawn, expected, strict=True))
    np.testing.assert_allclose(median, np.median(expected, axis=0))
    assert "10 mm/s" in imaged.get_title()
