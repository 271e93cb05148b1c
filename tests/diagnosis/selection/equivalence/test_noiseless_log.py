"""The log that reads what an explanation predicts."""

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, log_of

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.equivalence.noiseless_log import names_scatter, noiseless_log

BIAS_N_MM = 0.4


@pytest.fixture(scope="module")
def coarse():
    return coarse_of(log_of(NOMINAL, seconds=6.0))


def explained_by(coarse, **strong):
    """An explanation by effects as strong as told, in units of a fit."""
    start = coarse.parameterization(tuple(strong)).joined({n: np.array([v]) for n, v in strong.items()})
    return candidate(fit_effects(coarse, tuple(strong), start, most_iterations=0))


def test_of_an_offset_half_is_half_of_what_it_changes(coarse):
    log = noiseless_log(coarse, explained_by(coarse, torque_bias=BIAS_N_MM), ())
    np.testing.assert_allclose(log.middle, 0.5 * log.changed, atol=1e-9)
    assert log.power == pytest.approx(float(log.changed @ log.changed))
    assert log.power > 1.0


def test_the_explanation_leaves_nothing_of_its_own_log(coarse):
    log = noiseless_log(coarse, explained_by(coarse, torque_bias=BIAS_N_MM), ())
    assert np.abs(log.readings(log.own | log.kept)).max() < 1e-9
    assert np.abs(log.readings(log.halved)).max() > 1.0


def test_readings_that_the_log_lacks_are_lacking(coarse):
    trial = coarse.log.trials[0]
    own = noiseless_log(coarse, explained_by(coarse, torque_bias=BIAS_N_MM), ()).problem.log.trials[0]
    for sensor, values in trial.readings.items():
        np.testing.assert_array_equal(np.isfinite(own.readings[sensor]), np.isfinite(values))


def test_slopes_of_what_is_open_are_those_of_a_gain(coarse):
    """Stiffness and damping that the explanation names are open where they may be another's scatter."""
    best = explained_by(coarse, torque_bias=BIAS_N_MM)
    slopes, weights = noiseless_log(coarse, best, ()).slopes()
    assert slopes.shape == (sum(r.size for r in best.fit.by_trial), weights.size)
    assert np.isfinite(slopes).all()
    assert not names_scatter(best)
