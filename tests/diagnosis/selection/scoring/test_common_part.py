"""What the residuals of tip and torque have in common."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, fit_of, log_of, problem_of

from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.scoring.common_part import common_part


@pytest.fixture(scope="module")
def problem():
    return problem_of(log_of(NOMINAL, seconds=40.0), sigma=NOISE.sigma)


def left_of(problem, common, seed=1):
    """A fit that leaves white noise, a share of which is the same in both sensors."""
    size = problem.log.trials[0].time_s.size
    rng = np.random.default_rng(seed)
    both, *own = rng.normal(size=(3, size))
    each = [np.sqrt(common) * both + np.sqrt(1.0 - common) * one for one in own]
    return fit_of((), by_trial=[np.concatenate(each)])


def test_noise_of_two_sensors_has_nothing_in_common(problem):
    found = [common_part(problem, left_of(problem, 0.0, seed)) for seed in range(40)]
    # A standard normal: the mean of 40 scatters by 0.16, their deviation by 11 %.
    assert abs(np.mean(found)) < 0.55
    assert np.std(found) == pytest.approx(1.0, abs=0.4)


def test_a_part_that_both_show_is_told_in_standard_deviations(problem):
    """Forty blocks of a second, and a correlation of 0.8."""
    assert common_part(problem, left_of(problem, 0.8)) == pytest.approx(0.8 * np.sqrt(40), rel=0.2)


@pytest.mark.parametrize("begin_s", [-30.0, 1e5])
def test_it_does_not_hang_on_when_a_clock_was_set_to_zero(problem, begin_s):
    trials = (replace(own, time_s=own.time_s + begin_s) for own in problem.log.trials)
    later = replace(problem, log=replace(problem.log, trials=tuple(trials)))
    fit = left_of(problem, 0.8)
    assert common_part(later, fit) == pytest.approx(common_part(problem, fit), rel=0.1)


def test_with_one_sensor_there_is_nothing_to_compare():
    log = log_of(NOMINAL, seconds=10.0)
    (one,) = log.trials
    alone = replace(one, table=one.table.drop(columns="tip_angle_deg"))
    problem = problem_of(replace(log, trials=(alone,)), sigma=NOISE.sigma)
    size = problem.log.trials[0].time_s.size
    assert common_part(problem, fit_of((), by_trial=[np.ones(size)])) == 0.0
