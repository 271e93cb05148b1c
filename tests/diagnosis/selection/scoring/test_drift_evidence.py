"""Scores of explanations with and without a drift of a sensor are comparable."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of

from diagnosis.criteria.noise import DRIFT_SIZES_SIGMA
from diagnosis.criteria.selection import MOST_QUIETENED
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.prepare.noise.drift import AllowedDrift
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.selection.candidate import candidate
from diagnosis.selection.scoring.drift_evidence import (
    in_noise,
    likeliest_drift,
    noise_of_a_reading,
    score_beside_drift,
    wide_drifts,
)

SIGMA, COUNT = 0.02, 1000
TIME = 0.02 * np.arange(COUNT)


class Trial:
    """A trial of torque alone."""

    time_s = TIME
    readings = {TORQUE: np.zeros(COUNT)}  # noqa: RUF012 - never changed

    def has(self, sensor):
        return sensor == TORQUE


SENSORS = SimpleNamespace(by_column=lambda: {TORQUE: SIGMA})
RIG = SimpleNamespace(sensors=SENSORS)
LOG = SimpleNamespace(trials=(Trial(),), means_of=1, noise_left={}, rig=RIG)
PROBLEM = FitProblem(log=LOG, noise=Noise(sigma={TORQUE: SIGMA}), nuisance=())


def left(drift, seed=0):
    """A nominal rig that leaves noise and this drift, both in sigma."""
    values = np.random.default_rng(seed).normal(size=COUNT) + drift
    return candidate(fit_of((), by_trial=[values], jacobian=(np.zeros((COUNT, 0)),)))


def with_size(sigmas, zeroed=False):
    noise = PROBLEM.noise.with_drift(TORQUE, AllowedDrift(size=sigmas * SIGMA, zeroed=zeroed))
    return replace(PROBLEM, noise=noise)


def score(one, problem):
    return score_beside_drift(in_noise(one, PROBLEM, problem.noise), problem)


def walk(size_sigma, seed):
    """A random walk whose end is of that size."""
    steps = np.random.default_rng(seed).normal(size=COUNT)
    return size_sigma * np.cumsum(steps) / np.sqrt(COUNT)


def test_noise_alone_is_likelier_without_drift_and_a_walk_with_it():
    """Allowing for what is not there costs; leaving out what is costs more."""
    quiet, drifting = left(0.0), left(walk(2.0, 1))
    assert score(quiet, PROBLEM) < score(quiet, with_size(0.25))
    assert score(drifting, with_size(1.0)) < score(drifting, PROBLEM)


def test_the_score_is_the_likelihood_of_the_covariance_of_both():
    one, problem = left(walk(1.0, 2)), with_size(0.5)
    drift, r = problem.noise.drift(TORQUE), one.fit.by_trial[0]
    covariance = drift.restored(TIME, drift.restored(TIME, np.eye(COUNT)))
    expected = r @ np.linalg.solve(covariance, r) + np.linalg.slogdet(covariance)[1]
    more = one.score - one.fit.cost  # what its freedom costs, in any noise
    assert score(one, problem) - more == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("size", [1.0, 4.0])
def test_the_likeliest_size_is_near_the_true_one(size):
    """The cosines of a walk that ends so far off on average have amplitudes of size sqrt(2) / (pi k)."""
    found = [likeliest_drift(PROBLEM, TORQUE, [left(walk(size, s), s)], zeroed=True) for s in range(6)]
    sizes = [noise.drifts[TORQUE].size / SIGMA for noise in found]
    true = size * np.sqrt(2.0) / np.pi
    assert true / 1.6 <= np.exp(np.mean(np.log(sizes))) <= 1.6 * true


def test_a_constant_is_likelier_where_no_trial_begins_at_zero():
    raised = left(2.0 + walk(0.5, 3))
    assert score(raised, with_size(0.5)) < score(raised, with_size(0.5, zeroed=True))
    zeroed = left(walk(0.5, 3))
    assert score(zeroed, with_size(0.5, zeroed=True)) < score(zeroed, with_size(0.5))


def test_wide_drifts_are_wide_then_the_largest_and_begin_anywhere():
    wide, widest = (noise.drifts[TORQUE] for noise in wide_drifts(PROBLEM, TORQUE))
    assert wide.size < widest.size == pytest.approx(max(DRIFT_SIZES_SIGMA) * SIGMA)
    assert not wide.zeroed
    assert not widest.zeroed


@pytest.mark.parametrize(
    ("claimed", "told"), [(0.5, 1.0), (2.0, 2.0), (10.0 * MOST_QUIETENED, MOST_QUIETENED)]
)
@pytest.mark.parametrize("sensor", [TORQUE, TIP])
def test_a_filter_takes_off_noise_but_not_off_a_drift(claimed, told, sensor):
    sensors = SimpleNamespace(by_column=lambda: {sensor: claimed})
    log = SimpleNamespace(rig=SimpleNamespace(sensors=sensors), means_of=4, noise_left={})
    problem = SimpleNamespace(log=log, noise={sensor: 1.0})
    assert noise_of_a_reading(problem, sensor) == pytest.approx(2 * told)


def test_a_drift_is_that_of_readings_before_they_were_smoothed():
    sensors = SimpleNamespace(by_column=lambda: {TORQUE: 1.0})
    rig = SimpleNamespace(sensors=sensors)
    log = SimpleNamespace(rig=rig, means_of=4, noise_left={TORQUE: 0.25})
    problem = SimpleNamespace(log=log, noise={TORQUE: 1.0})
    assert noise_of_a_reading(problem, TORQUE) == pytest.approx(8.0)
