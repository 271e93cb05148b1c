"""Lines of pictures, from one reading to the next."""

import numpy as np

from diagnosis.residuals.between_readings import between_readings

TIME_S = np.arange(0.0, 2.0, 0.1)


def read(*rows):
    return np.where(np.isin(np.arange(TIME_S.size), rows), 3.0 * TIME_S, np.nan)


def test_a_slow_sensor_is_a_line():
    line = between_readings(TIME_S, read(*range(2, 18, 3)))
    np.testing.assert_allclose(line[2:18], 3.0 * TIME_S[2:18])
    assert np.isnan(line[[0, 1, 18, 19]]).all()


def test_a_gap_stays_a_gap():
    line = between_readings(TIME_S, read(0, 1, 2, 3, 4, 12, 13, 14))
    np.testing.assert_array_equal(np.isnan(line[5:12]), True)
    np.testing.assert_allclose(line[12:15], 3.0 * TIME_S[12:15])


def test_all_or_next_to_nothing_stays_as_it_is():
    for values in (3.0 * TIME_S, read(), read(4)):
        np.testing.assert_array_equal(between_readings(TIME_S, values), values)
