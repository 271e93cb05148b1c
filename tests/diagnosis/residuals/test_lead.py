"""Which residual leads: shifted copies, unrelated residuals, and effects at the two ends of a shaft."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, TIP, TORQUE, prepared, trial, turns
from scipy.signal import lfilter

from diagnosis.effects import LIBRARY
from diagnosis.fitting.parameterization import parameterization_of, starts
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.residuals.lead import lead

STEP, SIZE = 0.01, 2000
NAMES = ("base_torque_n_mm", "tip_angle_deg")


def slow(rng, size):
    """A residual of memory one second and size three, without its noise."""
    return 3 * lfilter([np.sqrt(1 - 0.98**2)], [1, -0.98], rng.normal(size=size + 500))[500:]


def shifted(steps, *, sign=1.0, seed=0):
    """Three trials of a residual and a late copy of it, both with noise."""
    rng = np.random.default_rng(seed)
    for _ in range(3):
        one = slow(rng, SIZE + steps)
        noise = rng.normal(size=(2, SIZE))
        yield one[steps:] + noise[0], sign * one[:SIZE] + noise[1]


@pytest.mark.parametrize("steps", [1, 20])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_late_copy_is_behind_by_its_delay(steps, sign):
    found = lead(NAMES, list(shifted(steps, sign=sign)), STEP)
    assert found.signal == "base_torque_n_mm"
    assert found.low_s < found.by_s < found.high_s
    assert found.by_s == pytest.approx(steps * STEP, abs=0.003)
    assert np.sign(found.correlation) == sign


def test_a_correlation_is_1_at_most_where_the_ends_are_quiet():
    """A copy that is late by a second; the first second of the one and the last of the other are 0."""
    rng = np.random.default_rng(2)
    one, late = np.zeros(SIZE), np.zeros(SIZE)
    one[500:1500] = rng.normal(size=1000)
    late[600:1600] = one[500:1500]
    found = lead(NAMES, [(one, late)] * 3, STEP)
    assert found.by_s == pytest.approx(1.0, abs=0.003)
    assert 0.9 < found.correlation <= 1.0


def test_the_second_leads_where_the_first_is_the_copy():
    found = lead(NAMES, [(late, one) for one, late in shifted(20)], STEP)
    assert found.signal == "tip_angle_deg"
    assert found.low_s < 0.2 < found.high_s


def test_the_interval_covers_the_delay_in_95_of_100():
    found = [lead(NAMES, list(shifted(10, seed=s)), STEP) for s in range(40)]
    assert all(one.signal == "base_torque_n_mm" for one in found)
    covered = sum(one.low_s <= 0.1 <= one.high_s for one in found)
    assert covered >= 34  # of 40; fewer are covered once in 70 where 95 of 100 are


def test_copies_without_a_delay_seldom_lead():
    found = [lead(NAMES, list(shifted(0, seed=s)), STEP) for s in range(40)]
    assert sum(bool(one.signal) for one in found) <= 6


@pytest.mark.parametrize("related", ["white", "slow"])
def test_unrelated_residuals_do_not_lead(related):
    rng = np.random.default_rng(1)
    make = slow if related == "slow" else lambda rng, size: rng.normal(size=size)
    for _ in range(20):
        found = lead(NAMES, [(make(rng, SIZE), make(rng, SIZE)) for _ in range(3)], STEP)
        assert found.signal == ""


def test_missing_samples_do_not_move_the_lead():
    rng = np.random.default_rng(2)
    parts = list(shifted(20))
    for values in (v for pair in parts for v in pair):
        values[rng.random(SIZE) < 0.3] = np.nan
    found = lead(NAMES, parts, STEP)
    assert found.signal == "base_torque_n_mm"
    assert found.by_s == pytest.approx(0.2, abs=0.01)


def test_a_few_seconds_or_one_sensor_cannot_say_it():
    assert lead(NAMES, [(np.ones(300), np.ones(300))], STEP) is None
    assert lead(NAMES, [], STEP) is None


@pytest.mark.parametrize(
    ("effect", "leads"),
    [
        ("base_compliance", "base_torque_n_mm"),
        ("tip_drag", "tip_angle_deg"),
        ("coulomb_friction", ""),
        ("tip_sensor_delay", ""),
    ],
)
def test_the_end_of_the_shaft_at_which_an_effect_is_leads(effect, leads):
    time = np.arange(0, 24, STEP)
    there = np.interp(time, [0, 1, 7, 9, 14, 17, 22], [0, 0, 60, 60, -20, -20, 0])
    sines = 30 * np.sin(np.pi * time) + 20 * np.sin(0.26 * np.pi * time)
    own = parameterization_of([effect])
    rig = own.rig(own.joined({effect: starts(LIBRARY[effect])[1]}))
    rng, parts = np.random.default_rng(0), []
    for motion in (turns(24.0), there, sines):
        nominal, real = predict(RIG, prepared(trial(motion)), [NOMINAL, rig])
        torque = (real.base_torque_n_mm - nominal.base_torque_n_mm) / TORQUE
        tip = (real.tip_angle_deg - nominal.tip_angle_deg) / TIP
        parts.append((torque + rng.normal(size=time.size), tip + rng.normal(size=time.size)))
    assert lead(NAMES, parts, STEP).signal == leads
