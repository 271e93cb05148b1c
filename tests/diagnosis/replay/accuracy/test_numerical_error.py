"""The replay measures its own error."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of

from diagnosis.criteria.replay import NUMERICAL_ERROR_WARNED
from diagnosis.replay.accuracy.numerical_error import (
    numerical_error,
    numerical_warnings,
    refinement_change,
)
from diagnosis.replay.replay import replay
from diagnosis.replay.resolution import COARSE, FINE
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

DRY = RigParameters(kinetic_n_mm_per_mm=0.002)


@pytest.fixture(scope="module")
def problem():
    return problem_of(log_of(NOMINAL))


def error(problem, resolution):
    """Of a rig with dry friction, by sensor."""
    predictions = replay(problem.log, DRY, resolution)
    return numerical_error(refinement_change(problem.log, problem.noise, DRY, predictions, resolution))


def test_the_replay_measures_its_own_error(problem):
    fine, coarse = error(problem, FINE), error(problem, COARSE)
    assert max(fine.values()) < NUMERICAL_ERROR_WARNED
    # Half the elements on the same samples; dry friction leaves order 1.5 of the elements: 2.8 times.
    assert coarse["base_torque_n_mm"] > 2 * fine["base_torque_n_mm"]


def test_readings_that_are_missing_do_not_count(problem):
    one = problem.log.trials[0]
    half = np.where(one.time_s < 6, np.nan, one.readings["tip_angle_deg"])
    log = replace(problem.log, trials=(replace(one, readings={"tip_angle_deg": half}),))
    (change,) = refinement_change(log, problem.noise, DRY, replay(log, DRY), FINE)
    assert list(change) == ["tip_angle_deg"]
    assert change["tip_angle_deg"].size == np.isfinite(half).sum()


def test_the_error_is_the_root_mean_square_over_all_trials():
    changes = [{"tip_angle_deg": np.array([3.0, 4.0])}, {"tip_angle_deg": np.zeros(2)}]
    assert numerical_error(changes) == {"tip_angle_deg": pytest.approx(2.5)}


def test_a_sensor_that_the_replay_is_too_coarse_for_is_named():
    (warning,) = numerical_warnings({"tip_angle_deg": 0.3, "base_torque_n_mm": 0.1})
    assert warning.startswith("tip_angle_deg: the numerical error of the replay is 0.300 σ")
