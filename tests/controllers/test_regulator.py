"""Linear-quadratic regulators: Riccati's equation, the grid of designs, and known delays."""

import math

import numpy as np
import pytest
from scipy.linalg import solve_continuous_are

from controllers.limits import MotorLimits
from controllers.prediction import LoopTiming
from controllers.regulator import PredictiveRegulator, Regulator
from controllers.signals import Estimate, Sample
from models.errors import InvalidValue
from models.needle import NITINOL
from models.servo import Servo

BETA = 0.01725
LIMITS = MotorLimits()
NO_LIMITS = MotorLimits(rate_deg_s=1e9, torque_n_mm=1e9)
SERVO = Servo(natural_frequency_hz=10)


def sample(time=0.0, base=0.0, torque=0.0, depth=100.0):
    return Sample(time, base, torque, depth, 50.0)


def estimate(damping=BETA, tip=0.0):
    return Estimate(tip, np.zeros(3), damping)


def riccati_gain(a, b, tip, weight=0.02):
    solution = solve_continuous_are(a, b, tip.T @ tip, np.array([[weight**2]]))
    return (b.T @ solution / weight**2)[0]


def test_the_gain_of_the_regulator_solves_riccatis_equation():
    regulator = Regulator(NITINOL, NO_LIMITS, damping_n_mm_s_per_mm=BETA, weight_s=0.02)
    modes, gain = regulator.design(sample(), estimate())
    a = np.diag([0.0, *modes.poles])
    b = np.array([1.0, *(-modes.participation)])[:, None]
    assert gain == pytest.approx(riccati_gain(a, b, np.ones((1, 4))), rel=1e-6)
    assert np.linalg.eigvals(a - b @ gain[None]).real.max() < 0


def test_with_a_servo_its_angle_and_rate_are_states_of_the_design():
    timing = LoopTiming(servo=SERVO)
    regulator = PredictiveRegulator(NITINOL, NO_LIMITS, timing, damping_n_mm_s_per_mm=BETA)
    modes, gain = regulator.design(sample(), estimate())
    w, d, n = SERVO.rate_rad_s, SERVO.damping_ratio, 3 + modes.poles.size
    a = np.zeros((n, n))
    a[1, 2] = 1.0
    a[2, :3] = w**2, -(w**2), -2 * d * w
    a[3:, 2] = -modes.participation
    a[3:, 3:] = np.diag(modes.poles)
    b = np.eye(n)[:, :1]
    tip = np.array([[0.0, 1.0, 0.0, *np.ones(n - 3)]])
    assert gain == pytest.approx(riccati_gain(a, b, tip), rel=1e-5)


def test_designs_are_made_once_for_every_two_millimetres_and_five_per_cent_of_damping():
    regulator = Regulator(NITINOL, LIMITS, damping_n_mm_s_per_mm=BETA)
    near, same, other = (regulator.design(sample(depth=d), estimate())[0] for d in (100.0, 100.9, 103.0))
    assert near is same
    assert other is not near
    assert regulator.design(sample(), estimate(1.02 * BETA))[0] is near
    thicker = regulator.design(sample(), estimate(1.5 * BETA))[0]
    assert thicker.poles == pytest.approx(near.poles / 1.5, rel=0.03)
    assert regulator.design(sample(), estimate(math.nan))[0] is near


def rates(regulator, references):
    """Commanded rates to an estimate that stays at 0, deg/s."""
    commands = [
        regulator.command(reference, sample(0.01 * i), estimate()).base_deg
        for i, reference in enumerate(references)
    ]
    return np.diff(commands) / 0.01


def test_without_delay_and_servo_the_predictive_regulator_is_the_regulator():
    plain = Regulator(NITINOL, LIMITS, damping_n_mm_s_per_mm=BETA)
    ahead = PredictiveRegulator(NITINOL, LIMITS, LoopTiming(), damping_n_mm_s_per_mm=BETA)
    references = [0.0, *[30.0] * 10]
    assert rates(ahead, references) == pytest.approx(rates(plain, references))


def test_the_predictive_regulator_knows_the_lag_that_late_sensors_do_not_show_yet():
    """To sensors that show nothing, the tip seems to follow; commands in flight say that it lags."""
    plain = Regulator(NITINOL, NO_LIMITS, damping_n_mm_s_per_mm=BETA)
    late = LoopTiming(measurement_delay_s=0.05)
    ahead = PredictiveRegulator(NITINOL, NO_LIMITS, late, damping_n_mm_s_per_mm=BETA)
    references = [0.0, *[30.0] * 5]
    without, within = rates(plain, references), rates(ahead, references)
    assert within[0] == pytest.approx(without[0])
    assert np.all(within[1:] > 1.2 * without[1:])


@pytest.mark.parametrize(
    ("changes", "field"),
    [({"weight_s": 0}, "weight_s"), ({"damping_n_mm_s_per_mm": -1}, "damping"), ({"order": 0}, "order")],
)
def test_an_impossible_regulator_is_refused_at_construction(changes, field):
    with pytest.raises(InvalidValue, match=field):
        Regulator(NITINOL, LIMITS, **({"damping_n_mm_s_per_mm": BETA} | changes))
