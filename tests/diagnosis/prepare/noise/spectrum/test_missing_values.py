"""Values that were not read, drawn from what an autoregression says of them."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.spectrum.missing_values import completed

SIZE, DRAWS = 60, 4000


def covariances(size):
    """Of y[i] = 1.5 y[i - 1] - 0.8 y[i - 2] + w[i], of variance 1, from its answer to a pulse."""
    pulse = lfilter([1], [1, -1.5, 0.8], np.eye(1, 4000)[0])
    found = np.array([pulse[: pulse.size - lag] @ pulse[lag:] for lag in range(size)])
    return found / found[0]


MODEL = Autoregression(autocovariances=tuple(covariances(5)), step_s=0.01)
WHOLE = covariances(SIZE)[np.abs(np.arange(SIZE)[:, None] - np.arange(SIZE))]


@pytest.mark.parametrize("missing", [[30], [20, 21, 25, 40], [*range(22, 32)]])
def test_mean_and_covariance_are_those_of_normal_values_given_the_others(missing):
    """By the whole covariance: S_mr S_rr^-1 y_r, and S_mm - S_mr S_rr^-1 S_rm."""
    rng = np.random.default_rng(1)
    values = np.linalg.cholesky(WHOLE) @ rng.normal(size=SIZE)
    read = np.setdiff1d(np.arange(SIZE), missing)
    onto = WHOLE[np.ix_(missing, read)] @ np.linalg.inv(WHOLE[np.ix_(read, read)])
    mean = onto @ values[read]
    covariance = WHOLE[np.ix_(missing, missing)] - onto @ WHOLE[np.ix_(read, missing)]
    holes = values.copy()
    holes[missing] = np.nan
    drawn = np.array([completed(MODEL, holes, rng) for _ in range(DRAWS)])
    np.testing.assert_array_equal(drawn[:, read], np.tile(values[read], (DRAWS, 1)))
    # Means of so many draws scatter by 1 / sqrt(4000) of the standard deviation; 4.5 of these.
    error = 4.5 * np.sqrt(np.diag(covariance) / DRAWS)
    assert (np.abs(drawn[:, missing].mean(axis=0) - mean) < error).all()
    np.testing.assert_allclose(
        np.cov(drawn[:, missing].T), covariance.squeeze(), atol=0.1 * covariance.max()
    )


def test_values_that_were_all_read_stay():
    values = np.arange(8.0)
    assert completed(MODEL, values, np.random.default_rng(0)) is values
