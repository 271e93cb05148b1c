"""By how much costs may differ for what no model resolves."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, TIP, TORQUE, log_of, problem_of

from diagnosis.criteria.selection import CONTENDING, LAW_UNRESOLVED_SHARE, UNRESOLVED_SHARE
from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.scoring.unresolved import contending, unresolved_cost, unresolved_law_cost

SIGMA = {"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": BASE}


@pytest.fixture(scope="module")
def problem():
    return problem_of(log_of(NOMINAL), sigma=SIGMA)


def with_readings(problem, **readings):
    (trial,) = problem.log.trials
    trial = replace(trial, readings={**trial.readings, **readings})
    return replace(problem, log=replace(problem.log, trials=(trial,)))


def test_it_grows_with_the_square_of_readings_in_units_of_noise(problem):
    size = problem.log.trials[0].time_s.size
    still = {"tip_angle_deg": problem.log.trials[0].base_motion_deg}
    one = with_readings(problem, base_torque_n_mm=np.full(size, 1000 * TORQUE), **still)
    assert unresolved_cost(one) == pytest.approx(size * (1000 * UNRESOLVED_SHARE) ** 2)
    two = with_readings(problem, base_torque_n_mm=np.full(size, 2000 * TORQUE), **still)
    assert unresolved_cost(two) == pytest.approx(4 * unresolved_cost(one))


def test_a_tip_that_turns_far_along_with_the_base_is_resolved(problem):
    size = problem.log.trials[0].time_s.size
    base, none = problem.log.trials[0].base_motion_deg, np.full(size, np.nan)
    along = with_readings(problem, base_torque_n_mm=none, tip_angle_deg=base)
    behind = with_readings(problem, base_torque_n_mm=none, tip_angle_deg=base - 100 * TIP)
    assert unresolved_cost(along) == 0.0
    assert unresolved_cost(behind) == pytest.approx(size * (100 * UNRESOLVED_SHARE) ** 2)


def test_with_the_readings_of_a_usual_log_it_is_less_than_any_odds(problem):
    assert unresolved_cost(problem) < 5.0


def test_what_is_out_of_the_question_is_behind_by_more_than_what_is_unresolved(problem):
    loud = with_readings(problem, base_torque_n_mm=np.full(problem.log.trials[0].time_s.size, 50.0))
    assert contending(loud) - contending(problem) == pytest.approx(
        unresolved_cost(loud) - unresolved_cost(problem)
    )
    assert contending(problem) > CONTENDING


def test_laws_leave_open_a_share_of_what_effects_change():
    """A torque that is off by 50 times its noise in every sample."""
    off = problem_of(log_of(replace(NOMINAL, torque_bias_n_mm=50 * TORQUE)), sigma=SIGMA)
    size = off.log.trials[0].time_s.size
    found = unresolved_law_cost(off, fit_effects(off, ["torque_bias"]))
    assert found == pytest.approx(size * (50 * LAW_UNRESOLVED_SHARE) ** 2, rel=0.01)
    assert unresolved_law_cost(off, fit_effects(off, [])) < 1e-3
