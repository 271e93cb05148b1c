"""Residuals in the parts of a motion."""

import numpy as np
import pytest
from diagnosis_fixtures import trial, turns

from diagnosis.criteria.residuals import ANGLE_PARTS
from diagnosis.residuals.along_motion import BASE_ANGLE, RATE, SINCE_REVERSAL, part_means

TRIAL = trial(turns(step=0.002), step=0.002)


def means(coordinate, values):
    places = [coordinate.of(TRIAL)]
    return np.array(part_means(places, [values], coordinate.edges(places)))


def test_a_mean_is_that_of_the_part():
    place = np.repeat([0.5, 1.5, 2.5], 30)
    found = part_means([place], [place**2], np.array([0.0, 1.0, 2.0, 3.0]))
    assert found == [(0.5, 0.25), (1.5, 2.25), (2.5, 6.25)]


def test_parts_with_few_samples_and_what_is_not_finite_are_left_out():
    place = np.repeat([0.5, 1.5, np.inf], [30, 19, 30])
    values = np.where(np.arange(79) < 5, np.nan, 1.0)
    assert part_means([place], [values], np.array([0.0, 1.0, 2.0])) == [(0.5, 1.0)]
    assert part_means([place[:10]], [values[:10]], np.array([0.0, 1.0, 2.0])) == []


def test_every_angle_of_the_stroke_is_in_a_part():
    angle = TRIAL["base_angle_deg"]
    edges = BASE_ANGLE.edges([angle])
    assert edges.size == ANGLE_PARTS + 1
    assert edges[0] <= angle.min()
    assert angle.max() < edges[-1]
    still = np.zeros(100)
    assert part_means([still], [still + 2], BASE_ANGLE.edges([still])) == [(0.0, 2.0)]


def test_what_depends_on_the_direction_steps_with_the_sign_of_the_rate():
    found = means(RATE, np.sign(RATE.of(TRIAL)))
    rate, value = found[np.abs(found[:, 0]) > 1].T
    assert rate.min() < -100
    assert rate.max() > 100
    np.testing.assert_array_equal(value, np.sign(rate))


def test_what_decays_after_a_reversal_is_largest_there():
    since = SINCE_REVERSAL.of(TRIAL)
    place, value = means(SINCE_REVERSAL, np.exp(-since)).T
    assert place[0] < 0.1
    assert (np.diff(place) > 0).all()
    # Parts are short beside the decay of one second but for the last, which averages a convex curve.
    np.testing.assert_allclose(value[:4], np.exp(-place[:4]), rtol=0.02)
    last = (since >= 5) & np.isfinite(since)
    assert value[-1] == pytest.approx(np.exp(-since[last]).mean())
