"""What the readings of a sensor follow beside an explanation."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, fit_of, problem_of
from drifting_logs import sliding

from diagnosis.fitting.fit import fit_effects
from diagnosis.log.trial import SENSORS, TIP, TORQUE
from diagnosis.prepare.noise.drift import AllowedDrift
from diagnosis.replay.replay import replay
from diagnosis.selection.scoring.followed import COURSES, followed, taken_off


@pytest.fixture(scope="module")
def problem():
    """A needle that turns while it slides, and is pushed in and drawn back."""
    found = problem_of(sliding(), sigma=NOISE.sigma)
    (one,) = found.log.trials
    rng, deep = np.random.default_rng(0), one.inserted_mm + 3.0 * np.sin(0.8 * one.time_s)
    one = replace(one, inserted_mm=deep)
    read = replay(replace(found.log, trials=(one,)))[0]
    readings = {s: read[s] + rng.normal(0.0, NOISE[s], one.time_s.size) for s in SENSORS}
    return replace(found, log=replace(found.log, trials=(replace(one, readings=readings),)))


def courses(trial):
    """What each law adds to the tip or the torque, in sigma, (N,)."""
    turned_deg, share = trial.base_motion_deg, trial.time_s / trial.time_s[-1]
    rate = np.gradient(turned_deg, trial.time_s)
    return {
        "axial speed": trial.speed_mm_s,
        "depth": np.sin(0.8 * trial.time_s),
        "rate of the tip": 2.0 * rate / np.abs(rate).max(),
        "direction of the tip": np.where(trial.time_s > 5.0, -1.0, 1.0) * (trial.time_s > 1.0),
        "angle of the tip": np.cos(np.deg2rad(turned_deg - 40.0)),
        "angle of the tip over time": turned_deg / 45.0 * (1.0 + share),
        "angle of the base": turned_deg / 45.0,
        "turn of the base": np.sin(np.deg2rad(turned_deg + 30.0)),
    }


def most_followed(problem, sensor=TIP):
    fit = fit_effects(problem, ())
    return max(followed(problem, fit, sensor), key=lambda law: law.gain)


@pytest.mark.parametrize(("sensor", "name"), [(s, name) for s in SENSORS for name in COURSES[s]])
def test_a_law_of_a_sensor_is_told_by_its_variable(problem, sensor, name):
    (one,) = problem.log.trials
    law = courses(one)[name]
    off = {**one.readings, sensor: one.readings[sensor] + problem.noise[sensor] * law}
    moved = replace(problem, log=replace(problem.log, trials=(replace(one, readings=off),)))
    found = most_followed(moved, sensor)
    assert found.name == name
    assert found.gain > 25.0
    several = ("angle of the tip", "angle of the tip over time", "turn of the base")
    assert found.parameters == (2 if name in several else 1)


@pytest.mark.parametrize("sensor", SENSORS)
def test_noise_follows_nothing_and_no_law_of_another_sensor(problem, sensor):
    """Gains of noise are chi-square: of one or two degrees of freedom, 25 in none of 10^5."""
    assert most_followed(problem, sensor).gain < 25.0
    (other,) = {*SENSORS} - {sensor}
    (one,) = problem.log.trials
    off = {**one.readings, other: one.readings[other] + 2.0 * problem.noise[other] * one.speed_mm_s}
    moved = replace(problem, log=replace(problem.log, trials=(replace(one, readings=off),)))
    assert most_followed(moved, sensor).gain < 25.0


def test_beside_a_drift_a_slow_law_is_told_less_certainly(problem):
    (one,) = problem.log.trials
    off = {**one.readings, TIP: one.readings[TIP] + problem.noise[TIP] * courses(one)["depth"]}
    moved = replace(problem, log=replace(problem.log, trials=(replace(one, readings=off),)))
    noise = problem.noise.with_drift(TIP, AllowedDrift(size=problem.noise[TIP]))
    assert most_followed(replace(moved, noise=noise)).gain < 0.2 * most_followed(moved).gain


def test_what_a_fit_answers_to_is_not_counted():
    """A residual along the slope of a parameter, and one that is half along it."""
    slope, beside = np.eye(10)[:, :1], np.eye(10)[:, 1:2]
    fit = fit_of(("tip_drag",), by_trial=[3.0 * (slope + beside)[:, 0]], jacobian=(slope,))
    assert taken_off(fit, slope + beside) == pytest.approx(9.0)
    assert taken_off(fit, np.column_stack([beside, beside])) == pytest.approx(9.0)


def test_the_torque_follows_no_course_of_the_needle():
    """Depth, rate and direction move it by what the needle does; of the base, elastic tissue alone."""
    assert [*COURSES[TORQUE]] == ["axial speed", "angle of the base", "turn of the base"]
