"""What the noise of the base's encoder makes of residuals."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, log_of, problem_of, scored

from diagnosis.criteria.fitting import BASE_NOISE_READINGS
from diagnosis.criteria.selection import SHIFT_LIMIT
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.scoring.base_noise import allowing_base_noise, with_base_noise_cost


def above_the_floor(rig, name, value):
    """A candidate of that effect, 10 % above the floor, on a log whose base was read with 0.02 deg.

    It swings to and fro: while it rests, the noise of its encoder is averaged out.
    """
    swing = 10 * np.sin(2 * np.pi * 0.4 * np.arange(0, 12, 0.01))
    quiet = problem_of(log_of(rig, speed=-1.0, angle=swing))
    noise = replace(quiet.noise, sigma={**quiet.noise.sigma, "base_angle_deg": 0.02})
    problem = replace(quiet, noise=noise)
    by_trial = [own[0] for own in problem.residuals([rig])]
    x = problem.parameterization((name,)).joined({name: np.array([value])})
    fit = fit_of((name,), by_trial=by_trial, x=x, nuisance=problem.nuisance)
    floor = NoiseFloor(gap=1.1, slow=1.3)
    return replace(candidate(fit), floor=floor), problem


def test_a_bearing_that_sticks_brings_the_noise_of_the_encoder_back_as_torque():
    """Within 0.1 deg of presliding 0.5 N mm are a spring of 5 N mm / deg, 300 sigma per deg."""
    rig = RigParameters(drive_friction_n_mm=0.5)
    one, problem = above_the_floor(rig, "drive_friction", np.log(0.5))
    allowed = allowing_base_noise(one, problem).floor
    assert (allowed.gap, allowed.slow) == (1.1, 1.3)
    assert allowed.gap_limit > 1.1 * one.floor.gap_limit
    assert allowed.slow_limit > 1.1 * one.floor.slow_limit


def stuck_twice():
    """A bearing that sticks, its log, and its fit and log with that trial twice."""
    stuck, problem = above_the_floor(
        RigParameters(drive_friction_n_mm=0.5), "drive_friction", np.log(0.5)
    )
    slopes = tuple(np.ones((r.size, stuck.fit.x.size)) for r in stuck.fit.by_trial)
    two = replace(stuck.fit, by_trial=stuck.fit.by_trial * 2, jacobian=slopes * 2)
    pair = replace(problem, log=replace(problem.log, trials=problem.log.trials * 2))
    return stuck, problem, two, pair


def test_trials_that_the_noise_of_the_encoder_sets_apart_may_shift_by_more():
    stuck, problem, two, pair = stuck_twice()
    allowed = allowing_base_noise(replace(stuck, fit=two), pair)
    assert allowed.shift_limit > SHIFT_LIMIT + 1.0
    assert allowing_base_noise(stuck, problem).shift_limit == SHIFT_LIMIT  # one trial cannot shift


def test_a_shift_of_held_out_trials_alone_asks_for_what_the_noise_of_the_encoder_allows():
    stuck, _, two, pair = stuck_twice()
    reached = replace(stuck, fit=two, floor=NoiseFloor(gap=1.0, slow=1.0))
    assert allowing_base_noise(reached, pair) is reached
    shifted = replace(reached, shift=SHIFT_LIMIT + 1.0)
    assert allowing_base_noise(shifted, pair).shift_limit > SHIFT_LIMIT + 1.0


def test_a_soft_needle_excuses_nothing():
    rig = RigParameters(tip_drag_n_mm_s_per_rad=0.05)
    one, problem = above_the_floor(rig, "tip_drag", np.log(0.05))
    allowed = allowing_base_noise(one, problem)
    assert allowed.floor.gap_limit < 1.01 * one.floor.gap_limit
    assert allowed.floor.slow_limit < 1.05 * one.floor.slow_limit
    assert not allowed.floor.reached


def test_what_is_far_above_the_floor_is_not_looked_at():
    far = scored(["tip_drag"], 1.0, floor=NoiseFloor(gap=3, slow=3))
    assert allowing_base_noise(far, None) is far


@pytest.mark.parametrize(
    ("rig", "name", "value", "readings"),
    [
        (RigParameters(drive_friction_n_mm=0.5), "drive_friction", 0.5, BASE_NOISE_READINGS),
        (RigParameters(tip_drag_n_mm_s_per_rad=0.05), "tip_drag", 0.05, 1),
    ],
)
def test_the_encoder_is_read_again_only_where_that_may_be_enough(
    rig, name, value, readings, monkeypatch
):
    one, problem = above_the_floor(rig, name, np.log(value))
    read_again, seen = FitProblem.read_again, []

    def counted(own, rng):
        seen.append(own)
        return read_again(own, rng)

    monkeypatch.setattr(FitProblem, "read_again", counted)
    allowing_base_noise(one, problem)
    assert len(seen) == readings


def late_of(names, *, gap=1.0, base_deg=0.02):
    """A torque that is late by 20 ms, in a log whose base was read with that noise."""
    problem = problem_of(log_of(NOMINAL))
    noise = replace(problem.noise, sigma={**problem.noise.sigma, "base_angle_deg": base_deg})
    problem = replace(problem, noise=noise)
    fit = fit_of(names, by_trial=[own[0] for own in problem.residuals([NOMINAL])])
    return replace(candidate(fit), floor=NoiseFloor(gap=gap, slow=gap)), problem


def test_the_noise_of_the_encoder_costs_a_late_sensor_in_proportion_to_its_square():
    costs = []
    for base_deg in (0.01, 0.02):
        late, problem = late_of(["torque_sensor_delay"], base_deg=base_deg)
        costs.append(with_base_noise_cost(late, problem).base_noise_cost)
    assert costs[0] > 0.0
    assert costs[1] == pytest.approx(4 * costs[0], rel=0.2)  # but for how far the motion is smoothed


@pytest.mark.parametrize("names", [["tip_drag"], ["torque_sensor_delay", "tip_drag"], []])
def test_that_cost_is_asked_of_a_late_sensor_alone(names):
    one = scored(names, 1.0, floor=NoiseFloor(gap=1.0, slow=1.0))
    assert with_base_noise_cost(one, None) is one


def test_that_cost_is_not_asked_above_the_floor():
    late, _ = late_of(["torque_sensor_delay"], gap=3.0)
    assert with_base_noise_cost(late, None) is late
