"""Effects of sensors: what each adds to its signal, and that it changes no other."""

from dataclasses import fields, replace

import numpy as np
import pytest

from validation.rig.unmodelled.effect import IdealSignals
from validation.rig.unmodelled.sensor import EFFECTS

SENSORS = {
    "tip_sensor_cubic": ({"cubic": 5.0}, "tip_deg", lambda s: 5 * (s.tip_deg / 180) ** 3),
    "tip_sensor_periodic": (
        {"amplitude": 2.0, "cycles": 3.0, "phase": 10.0},
        "tip_deg",
        lambda s: 2 * np.sin(np.radians(3 * s.tip_deg + 10)),
    ),
    "tip_sensor_jump": (
        {"angle": 7.0, "trial": 2.0, "share": 0.5},
        "tip_deg",
        lambda s: 7.0 * (s.time_s > 2.5),
    ),
    "torque_drift": ({"rate": 0.01}, "torque_n_mm", lambda s: 0.01 * s.time_s),
    "one_sided_torque_gain": (
        {"share": 0.2},
        "torque_n_mm",
        lambda s: 0.2 * s.torque_n_mm * (s.torque_n_mm > 0),
    ),
    "axial_crosstalk": ({"gain": 0.05}, "torque_n_mm", lambda s: 0.05 * s.speed_mm_s),
}
TRAILING = {"tip_sensor_lag", "tip_sensor_play"}


@pytest.fixture
def true():
    """There and back."""
    time_s = np.linspace(0, 5, 51)
    base = 200 * np.sin(1.3 * time_s)
    return IdealSignals(
        time_s=time_s,
        base_deg=base,
        torque_n_mm=0.01 * base,
        tip_deg=0.8 * base,
        speed_mm_s=np.full(51, 2.0),
        trial=2,
    )


@pytest.mark.parametrize("name", SENSORS)
def test_a_sensor_effect_changes_its_signal_and_no_other(name, true):
    parameters, changed, error = SENSORS[name]
    shown = EFFECTS[name].signals(true, parameters)
    assert getattr(shown, changed) - getattr(true, changed) == pytest.approx(error(true))
    for other in {field.name for field in fields(true)} - {changed}:
        assert np.array_equal(getattr(shown, other), getattr(true, other))


def test_a_sensor_shifts_in_its_trial_alone(true):
    shift = EFFECTS["tip_sensor_jump"].signals
    other = replace(true, trial=1)
    assert (shift(other, SENSORS["tip_sensor_jump"][0]).tip_deg == true.tip_deg).all()


def test_a_lagging_sensor_trails_a_ramp_by_its_time_constant(at_end):
    lag = at_end()[1] - at_end(tip_sensor_lag={"time_constant": 0.3})[1]
    assert lag == pytest.approx(0.3 * 60, rel=1e-3)


def test_a_coupling_with_play_trails_by_half_of_it_on_either_way(true):
    shown = EFFECTS["tip_sensor_play"].signals(true, {"width": 10.0}).tip_deg
    trails = true.tip_deg - shown
    going, coming = true.time_s < np.pi / 2.6, (true.time_s > 1.6) & (true.time_s < 3.3)
    assert trails[going][5:] == pytest.approx(5.0)
    assert trails[coming] == pytest.approx(-5.0)


def test_every_effect_is_of_the_signals_and_tested_here():
    assert {*SENSORS, *TRAILING} == {*EFFECTS}
    assert all(effect.signals for effect in EFFECTS.values())
