"""Residuals as a function of the fit's vector."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.fitting.objective import NearStart, Objective
from diagnosis.fitting.parameterization import parameterization_of
from diagnosis.replay.rig_parameters import RigParameters
from sim.needles.run import SimulationFailed

OPEN = (LIBRARY["stiffness_error"],)
DRAG = parameterization_of(("tip_drag",), OPEN)


class ClosedForm:
    """A problem whose two trials are known functions of a rig's tip drag and stiffness.

    With `waves`, slopes foretell no step.
    """

    def __init__(self, most_drag=np.inf, callback_alone=False, waves=0.0):
        self.most_drag, self.waves, self.rigs, self.by_callback = most_drag, waves, [], []
        self.callback_alone = callback_alone

    @property
    def of_differences(self):
        return self

    def residuals(self, rigs, *, callback_alone=False):
        self.rigs += rigs
        self.by_callback.append(callback_alone)
        if any(rig.tip_drag_n_mm_s_per_rad > self.most_drag for rig in rigs):
            raise SimulationFailed("too much drag")
        drag = [rig.tip_drag_n_mm_s_per_rad for rig in rigs]
        scale = [rig.stiffness_scale for rig in rigs]
        curves = [np.array([d, d**2 + self.waves * np.sin(100 * np.log(d))]) for d in drag]
        return [curves, [np.array([s]) for s in scale]]


def middle(stiffness=0.01):
    """A vector within bounds: some drag, some stiffness."""
    low, high = DRAG.bounds()
    return np.array([0.5 * (low[0] + high[0]), stiffness])


def test_residuals_are_trial_after_trial_and_then_the_prior():
    x = middle()
    drag = DRAG.rig(x).tip_drag_n_mm_s_per_rad
    expected = [drag, drag**2, np.exp(0.01), 0.0, 0.01 / SCATTER["stiffness_error"]]
    np.testing.assert_allclose(Objective(ClosedForm(), DRAG)(x), expected)


def test_a_fit_runs_the_callback_alone_and_its_end_is_a_run_of_mujoco():
    objective, x = Objective(ClosedForm(), DRAG), middle()
    objective.jacobian(x, objective(x))
    assert objective.problem.by_callback == [True, True]
    for end, way in zip(objective.at_the_end(x), objective.by_trial(x), strict=True):
        np.testing.assert_array_equal(end, way)
    assert objective.problem.by_callback == [True, True, False]


def test_a_fit_of_a_decimated_log_ends_without_mujoco():
    objective, x = Objective(ClosedForm(callback_alone=True), DRAG), middle()
    objective.at_the_end(x)
    assert objective.problem.by_callback == [True]


def test_slopes_are_those_of_the_closed_form():
    objective, x = Objective(ClosedForm(), DRAG, 1e-5), middle()
    slopes = objective.jacobian(x, objective(x))
    step = 1e-6 * np.eye(2)
    central = np.stack([(objective(x + s) - objective(x - s)) / 2e-6 for s in step], axis=-1)
    # One-sided: half the second derivative times the difference.
    np.testing.assert_allclose(slopes, central, rtol=1e-3, atol=1e-6)


def test_differences_of_runs_half_as_fine_give_nearly_the_same_slopes():
    """A hundredth off moves the end of a fit by as much of a standard deviation."""
    whole = problem_of(log_of(RigParameters(tip_drag_n_mm_s_per_rad=0.3), seconds=4.0))
    parameterization = whole.parameterization(("tip_drag",))
    x, slopes = parameterization.joined({}), []
    for problem in (whole, replace(whole, differences_halved=True)):
        objective = Objective(problem, parameterization)
        slopes.append(objective.jacobian(x, objective(x)))
    off = np.linalg.norm(slopes[1] - slopes[0], axis=0) / np.linalg.norm(slopes[0], axis=0)
    assert (off < 0.01).all()
    assert off.any()


def test_slopes_that_are_known_are_not_taken_again():
    known = np.arange(10.0).reshape(5, 2)
    objective, x = Objective(ClosedForm(), DRAG, slopes=known), middle()
    np.testing.assert_array_equal(objective.jacobian(x, objective(x)), known)
    assert len(objective.problem.rigs) == 1


def test_differences_stay_within_bounds():
    objective = Objective(ClosedForm(), DRAG)
    x = np.array([objective.high[0], 0.0])
    objective.jacobian(x, objective(x))
    most = DRAG.rig(objective.high).tip_drag_n_mm_s_per_rad
    assert max(rig.tip_drag_n_mm_s_per_rad for rig in objective.problem.rigs) <= most * (1 + 1e-12)


def test_slopes_of_the_nuisance_are_taken_again_only_far_away():
    objective, x = Objective(ClosedForm(waves=1.0), DRAG), middle()
    asked = []
    for moved in (0.0, 0.05, 0.5):
        there = x - [moved, 0.0]
        at_there = objective(there)
        before = len(objective.problem.rigs)
        objective.jacobian(there, at_there)
        asked.append(len(objective.problem.rigs) - before)
    assert asked == [2, 1, 2]


def test_slopes_hold_for_one_short_step_and_not_for_two_or_one_that_they_did_not_foretell():
    objective, x = Objective(ClosedForm(waves=1.0), DRAG), middle()
    asked = []
    for moved in (0.0, 0.01, 0.015, 0.065):
        there = x - [moved, 0.0]
        at_there = objective(there)
        before = len(objective.problem.rigs)
        objective.jacobian(there, at_there)
        asked.append(len(objective.problem.rigs) - before)
    assert asked == [2, 0, 1, 1]


@pytest.mark.parametrize("decimated", [True, False])
def test_slopes_that_foretold_a_step_hold_where_fits_only_tell_which_to_do_again(decimated):
    objective, x = Objective(ClosedForm(callback_alone=decimated), DRAG), middle()
    there = x + np.array([0.1, 0.005])
    objective.jacobian(x, objective(x))
    at_there = objective(there)
    before = len(objective.problem.rigs)
    objective.jacobian(there, at_there)
    assert (len(objective.problem.rigs) == before) is decimated


def test_slopes_that_foretold_a_step_hold_for_one_more_and_learn_what_they_missed_of_it():
    objective, x = Objective(ClosedForm(callback_alone=True), DRAG), middle()
    step = np.array([0.1, 0.005])
    there = x + step
    was, at_there = objective(x), objective(there)
    first = objective.jacobian(x, was)
    before = len(objective.problem.rigs)
    learned = objective.jacobian(there, at_there)
    assert len(objective.problem.rigs) == before
    np.testing.assert_allclose(learned @ step, at_there - was, rtol=1e-12)
    assert np.abs(first @ step - (at_there - was)).max() > 1e-4
    # Drag acts on the first trial, stiffness on the second: that was known, and remains.
    np.testing.assert_array_equal(learned == 0.0, first == 0.0)
    farther = there + step
    objective.jacobian(farther, objective(farther))
    assert len(objective.problem.rigs) == before + 3


def test_what_a_fit_without_the_effects_knows_of_the_start_is_not_simulated_again():
    """Its slopes along the nuisance, and its residuals where the effects change nothing."""
    problem, x = ClosedForm(), middle()
    known = (np.array([1.0, 2.0]), np.array([3.0]))
    objective = Objective(problem, DRAG)
    objective.learn_from(x, NearStart(slopes=np.array([[0.1], [0.2], [0.3]]), by_trial=known))
    at_x = objective(x)
    np.testing.assert_array_equal(at_x[:3], [1.0, 2.0, 3.0])
    assert problem.rigs == []
    slopes = objective.jacobian(x, at_x)
    assert len(problem.rigs) == 1  # the step along the drag
    weight = 1.0 / SCATTER["stiffness_error"]
    np.testing.assert_array_equal(slopes[:, 1], [0.1, 0.2, 0.3, 0.0, weight])


def test_where_effects_change_something_at_the_start_it_is_simulated():
    problem, x = ClosedForm(), middle()
    objective = Objective(problem, DRAG)
    objective.learn_from(x, NearStart(slopes=np.zeros((3, 1)), by_trial=None))
    np.testing.assert_array_equal(objective(x), Objective(ClosedForm(), DRAG)(x))
    assert len(problem.rigs) == 1


def test_slopes_of_a_fit_that_ended_at_the_start_hold_for_the_first_step_alone():
    """With its prior, which may be another one."""
    problem, x = ClosedForm(), middle()
    objective = Objective(problem, DRAG)
    known = np.array([[0.1, 0.4], [0.2, 0.5], [0.3, 0.6]])
    objective.learn_from(x, NearStart(slopes=known, by_trial=None))
    slopes = objective.jacobian(x, objective(x))
    np.testing.assert_array_equal(slopes[:3], known)
    np.testing.assert_array_equal(slopes[3:], np.diag(DRAG.weights))
    assert len(problem.rigs) == 1  # the residuals at the start
    there = x + np.array([0.2, 0.0])
    after = objective.jacobian(there, objective(there))
    np.testing.assert_allclose(
        after[:, 0], Objective(ClosedForm(), DRAG).jacobian(there, objective(there))[:, 0]
    )


def test_slopes_of_what_one_trial_alone_shows_are_taken_again_every_time():
    late = replace(LIBRARY["damping_error"], name="start", trial="trial_01.csv")
    parameterization = parameterization_of(("tip_drag",), (*OPEN, late))
    problem = ClosedForm(waves=1.0)
    objective = Objective(problem, parameterization)
    x = np.append(middle(), 0.0)
    objective.jacobian(x, objective(x))
    before = len(problem.rigs)
    objective.jacobian(x + 0.05, objective(x + 0.05))
    # The vector itself, and the columns of drag and of the start; stiffness is as it was.
    assert len(problem.rigs) - before == 3


def test_a_step_too_far_is_no_number_and_a_start_that_fails_is_an_error():
    x = middle()
    limit = 1.001 * DRAG.rig(x).tip_drag_n_mm_s_per_rad
    objective = Objective(ClosedForm(most_drag=limit), DRAG)
    with pytest.raises(SimulationFailed):
        objective(objective.high)
    assert np.isfinite(objective(x)).all()
    assert np.isnan(objective(objective.high)).all()
