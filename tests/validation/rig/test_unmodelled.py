"""Effects that the diagnosis does not model follow their stated laws."""

import math

import numpy as np
import pytest

from models.needle import NITINOL
from validation.rig.laws import LawParameters
from validation.rig.simulation import ideal_signals
from validation.rig.unmodelled import LAW_EFFECTS, SENSOR_EFFECTS, UNMODELLED, IdealSignals

BETA, DEPTH, RATE = 0.018, 100.0, math.radians(60)
VISCOUS = BETA * RATE * DEPTH


@pytest.fixture
def at_end(drive, make_rig, turn_steadily):
    """The last torque and tip angle after 12 s of steady turning, and the largest torque."""

    def run(**outside):
        signals = ideal_signals(make_rig(outside), drive(turn_steadily, end=12))
        return signals.torque_n_mm[-1], signals.tip_deg[-1], signals.torque_n_mm.max()

    return run


def test_a_chuck_slips_at_its_torque(at_end):
    assert at_end(slipping_chuck={"torque": 1.0})[2] == pytest.approx(1.0)


def test_lubrication_takes_away_its_share_of_the_damping(at_end):
    assert at_end(lubrication={"share": 0.5, "angle": 60.0})[0] == pytest.approx(0.5 * VISCOUS, rel=1e-3)


def test_a_damping_gradient_keeps_the_torque_and_moves_its_lever(at_end):
    """The moment of a damping 1 + g (2 x / l - 1) about the entry is l^2/2 (1 + g/3)."""
    torque, tip, _ = at_end(damping_gradient={"gradient": 0.6})
    assert torque == pytest.approx(VISCOUS, rel=1e-4)
    more = math.degrees(BETA * RATE * DEPTH**2 / 2 * 0.6 / 3 / NITINOL.rigidity_n_mm2)
    assert at_end()[1] - tip == pytest.approx(more, rel=1e-3)


def test_one_way_friction_depends_on_the_side(at_end):
    torque = at_end(one_way_friction={"level": 0.004, "asymmetry": 0.5})[0]
    assert torque - VISCOUS == pytest.approx(0.006 * DEPTH, rel=1e-3)


def test_a_hardening_shaft_twists_less(at_end):
    assert at_end(hardening_shaft={"coefficient": 1e4})[1] > at_end()[1] + 1


def test_a_lagging_sensor_trails_a_ramp_by_its_time_constant(at_end):
    lag = at_end()[1] - at_end(tip_sensor_lag={"time_constant": 0.3})[1]
    assert lag == pytest.approx(0.3 * 60, rel=1e-3)


def test_contacts_that_rested_hold_more(drive, make_rig):
    def rest_then_turn(time_s):
        return 90 * np.clip(time_s - 8, 0, 1)

    outside = {"friction_ageing": {"level": 0.002, "growth": 0.002, "time": 0.5, "angle": 1.0}}
    rested = ideal_signals(make_rig(outside), drive(rest_then_turn, end=10))
    fresh = ideal_signals(make_rig(outside), drive(lambda time_s: rest_then_turn(time_s + 8), end=2))
    assert rested.torque_n_mm.max() > fresh.torque_n_mm.max() + 0.02


SENSORS = {
    "torque_drift": ({"rate": 0.01}, "torque_n_mm", lambda t, b: 0.01 * t),
    "torque_ripple": (
        {"amplitude": 0.1, "teeth": 4.0, "phase": 30.0},
        "torque_n_mm",
        lambda t, b: 0.1 * np.sin(np.radians(4 * b + 30)),
    ),
    "tip_sensor_cubic": ({"cubic": 5.0}, "tip_deg", lambda t, b: 5 * (0.8 * b / 180) ** 3),
    "tip_sensor_periodic": (
        {"amplitude": 2.0, "cycles": 3.0, "phase": 10.0},
        "tip_deg",
        lambda t, b: 2 * np.sin(np.radians(3 * 0.8 * b + 10)),
    ),
    "eccentric_encoder": (
        {"amplitude": 3.0, "phase": 40.0},
        "base_deg",
        lambda t, b: 3 * (np.sin(np.radians(b + 40)) - np.sin(np.radians(40))),
    ),
    "axial_crosstalk": ({"gain": 0.05}, "torque_n_mm", lambda t, b: 0.05 * 2.0 + 0 * t),
}


@pytest.mark.parametrize("name", SENSORS)
def test_a_sensor_effect_changes_its_signal_and_no_other(name):
    parameters, changed, error = SENSORS[name]
    time_s = np.linspace(0, 5, 51)
    base = 70.0 * time_s
    true = IdealSignals(
        time_s=time_s,
        base_deg=base,
        torque_n_mm=0.01 * base,
        tip_deg=0.8 * base,
        speed_mm_s=np.full(51, 2.0),
    )
    shown = SENSOR_EFFECTS[name](true, parameters)
    assert getattr(shown, changed) - getattr(true, changed) == pytest.approx(error(time_s, base))
    for other in {"base_deg", "torque_n_mm", "tip_deg", "time_s", "speed_mm_s"} - {changed}:
        assert (getattr(shown, other) == getattr(true, other)).all()


@pytest.mark.parametrize("name", LAW_EFFECTS)
def test_a_law_effect_changes_the_law(name):
    values = {"coefficient": 9.0, "share": 0.4, "level": 0.01, "asymmetry": 0.3, "gradient": 0.2}
    values |= {"torque": 2.0, "growth": 0.01, "time": 0.3, "angle": 5.0}
    law = LawParameters(323.6, BETA, 0.295)
    assert LAW_EFFECTS[name](law, values) != law


def test_every_unmodelled_effect_is_of_the_law_or_of_a_sensor():
    assert (*LAW_EFFECTS, *SENSOR_EFFECTS) == UNMODELLED
    assert not {*LAW_EFFECTS} & {*SENSOR_EFFECTS}
    assert {*SENSORS, "tip_sensor_lag"} == {*SENSOR_EFFECTS}
