"""What is carried from stage to stage, in the interpreter."""

import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup

LIMIT = np.radians(0.1)


@pytest.fixture
def stage(at_stage):
    return at_stage(
        Setup(
            needle=NITINOL,
            tissue=Tissue.uniform(kinetic_n_mm_per_mm=0.001),
            discretisation=Discretisation(elements=4),
            free_mm=20,
            inserted_mm=60,
        )
    )


def _carried(interpreted, stage, before, kept, carried):
    w, frame = stage.w, stage.frame._replace(yield_angle=LIMIT)
    theta, rates = w.theta.copy(), w.rest.copy()
    w.omega[:] = rates + 1.0
    interpreted.carry.next_stage(stage.law, theta, rates, before, w, frame, kept, carried)
    return theta, rates


def test_a_first_order_method_starts_again_from_the_start(interpreted, stage):
    before = np.zeros_like(stage.w.start)
    theta, rates = _carried(interpreted, stage, before, 0.0, 0.0)
    assert np.array_equal(stage.w.theta, theta)
    assert np.array_equal(stage.w.rest, rates)


def test_all_that_is_reached_is_carried_where_the_method_says_so(interpreted, stage):
    """y0 + carried (y - y*), of angles, rates and presliding alike."""
    places, carried = interpreted.memory_map, 0.5
    before = np.zeros_like(stage.w.start)
    stage.w.start[:], stage.w.end[:] = 0.0, 0.4 * LIMIT
    theta, rates = _carried(interpreted, stage, before, 0.0, carried)
    assert stage.w.theta == pytest.approx(theta + carried * stage.frame.g * (rates + 1.0))
    assert stage.w.rest == pytest.approx(rates + carried)
    assert stage.w.start[..., places.Z_DRY] == pytest.approx(0.2 * LIMIT)


def test_presliding_stays_within_its_limit(interpreted, stage):
    """One element by itself, and the shared one as a vector, whose direction stays."""
    places = interpreted.memory_map
    before = np.zeros_like(stage.w.start)
    stage.w.start[:] = 0.0
    end = stage.w.end
    end[..., places.Z_DRY], end[..., places.Z_TURN] = -5 * LIMIT, 3 * LIMIT
    end[..., places.Z_AXIAL] = 4 * LIMIT
    _carried(interpreted, stage, before, 0.0, 1.0)
    start = stage.w.start
    assert start[..., places.Z_DRY] == pytest.approx(-LIMIT)
    assert start[..., places.Z_TURN] == pytest.approx(0.6 * LIMIT)
    assert start[..., places.Z_AXIAL] == pytest.approx(0.8 * LIMIT)


def test_what_a_contact_has_been_through_is_negative_only_where_it_has_a_sign(interpreted, stage):
    places = interpreted.memory_map
    before, stage.law = np.zeros_like(stage.w.start), stage.law.copy()
    for over, least in ((places.SLIP_SO_FAR, 0.0), (places.TURNED, -0.3)):
        stage.law[:, places.L_CONTACT] = over
        stage.w.start[:], stage.w.end[:] = 0.0, 0.0
        stage.w.end[..., places.PAST] = -0.3
        _carried(interpreted, stage, before, 0.0, 1.0)
        assert stage.w.start[..., places.PAST] == pytest.approx(least)
