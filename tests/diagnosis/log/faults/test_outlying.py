"""Outliers beside a model are far off in short runs, with quiet neighbours."""

import numpy as np
import pytest

from diagnosis.log.faults.outlying import few, outlying, without_few


@pytest.mark.parametrize(
    ("far", "found"),
    [
        ({50: 8.0}, {50}),
        ({50: 8.0, 51: -7.0}, {50, 51}),
        ({50: 8.0, 52: 4.0}, {50, 51, 52}),  # the end of a burst, off by less
        ({50: 8.0, 53: 8.0}, {50, 53}),
        ({50: 8.0, 62: 8.0} | dict.fromkeys(range(51, 62), 4.0), set()),
        ({50: 8.0, 52: -9.0, 53: 30.0}, {50, 51, 52, 53}),  # one burst, whatever is between
        (dict.fromkeys(range(50, 61), 8.0), set()),  # it lasts
        ({0: 8.0, 99: 8.0}, set()),  # nothing on one side
        ({50: 4.9}, set()),
    ],
)
def test_only_short_runs_with_quiet_neighbours_are_outliers(far, found):
    left = np.random.default_rng(0).uniform(-1.5, 1.5, 100)
    left[list(far)] = list(far.values())
    assert set(np.flatnonzero(outlying(left)).tolist()) == found


def test_a_drift_of_the_sensor_hides_no_outlier():
    """Four sigma that come and go in 400 readings, and a reading that is off by nine of them."""
    noise = np.random.default_rng(0).uniform(-1.5, 1.5, 1200)
    left = noise + 4 * np.sin(2 * np.pi * np.arange(1200) / 1600)
    left[[600, 601]] += 9.0
    assert set(np.flatnonzero(outlying(left)).tolist()) == {600, 601}


def test_outliers_that_are_few_become_nan():
    left = np.random.default_rng(0).uniform(-1.5, 1.5, 200)
    left[[50, 120]] = [8.0, np.nan]
    found = without_few(left)
    assert np.flatnonzero(np.isnan(found)).tolist() == [50, 120]
    np.testing.assert_array_equal(found[~np.isnan(found)], left[~np.isnan(found)])


def test_many_are_no_outliers():
    left = np.random.default_rng(0).uniform(-1.5, 1.5, 200)
    left[10:190:20] = 8.0
    assert not few(outlying(left))
    np.testing.assert_array_equal(without_few(left), left)
