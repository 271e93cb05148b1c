"""The predictor against the closed form of the needle, driven by the same commands."""

import numpy as np
import pytest

from controllers.modal_lag import BaseModes
from controllers.prediction import LoopTiming, Predictor
from models.errors import InvalidValue
from models.modes import InsertedNeedle
from models.needle import NITINOL
from models.servo import Servo

STEP_S, COUNT = 0.005, 6
HELD = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=0.01725, inserted_mm=100.0, free_mm=50.0)
MODES = BaseModes(HELD, COUNT, 3)
TIMES = STEP_S * np.arange(60)
COMMANDS = 90.0 * np.clip(TIMES / 0.1, 0, 1) + 20 * np.sin(30 * TIMES)


def shaft_of(timing):
    """Angle of a shaft without a servo at every sample, deg: the command one sample and latency ago."""
    late = round(timing.command_latency_s / STEP_S)
    return np.concatenate([np.zeros(late + 1), COMMANDS])[: TIMES.size]


@pytest.mark.parametrize(
    "timing",
    [
        LoopTiming(),
        LoopTiming(measurement_delay_s=0.04),
        LoopTiming(command_latency_s=0.02),
        LoopTiming(measurement_delay_s=0.03, command_latency_s=0.02),
    ],
    ids=["none", "sensors", "commands", "both"],
)
def test_the_state_at_the_arrival_of_a_command_is_what_the_needle_then_has(timing):
    shaft = shaft_of(timing)
    truth = HELD.respond(TIMES, np.radians(shaft), count=COUNT).modes_rad
    seen, arrival = (round(t / STEP_S) for t in (timing.measurement_delay_s, timing.command_latency_s))
    predictor, worst = Predictor(timing), 0.0
    for i in range(TIMES.size - arrival):
        late = max(i - seen, 0)
        predictor.advance(float(TIMES[i]), float(shaft[late]))
        ahead = predictor.predict(MODES, truth[late], float(shaft[late]))
        predictor.send(float(COMMANDS[i]))
        worst = max(worst, np.abs(ahead.lag_modes_rad - truth[i + arrival]).max())
        assert ahead.shaft_deg == pytest.approx(shaft[i + arrival], abs=1e-9)
    assert np.abs(truth).max() > 0.1
    assert worst < 1e-9  # exact: the shaft runs straight between samples in both


def test_behind_a_servo_shaft_and_rate_are_those_of_its_step_response():
    servo = Servo(natural_frequency_hz=10)
    predictor = Predictor(LoopTiming(command_latency_s=0.01, servo=servo))
    state = np.zeros(2)
    predictor.advance(0.0, 0.0)
    predictor.send(90.0)
    for i in range(1, 40):
        predictor.advance(STEP_S * i, 0.0)
        state = servo.after(state, 90.0, STEP_S)
        shaft_now = float(np.interp(STEP_S * i, *zip(*predictor._ahead, strict=True)))
        ahead = predictor.predict(MODES, np.zeros(COUNT), shaft_now)
        predictor.send(90.0)
        assert (ahead.shaft_deg, ahead.shaft_rate_deg_s) == pytest.approx(tuple(state), abs=1e-9)


def test_what_the_encoder_shows_beyond_the_model_shifts_the_prediction():
    predictor = Predictor(LoopTiming(measurement_delay_s=0.02))
    for i in range(10):
        predictor.advance(STEP_S * i, 0.0)
        predictor.send(0.0)
    assert predictor.predict(MODES, np.zeros(COUNT), 1.5).shaft_deg == pytest.approx(1.5)


def test_reset_forgets_the_commands_in_flight():
    predictor = Predictor(LoopTiming(measurement_delay_s=0.02))
    for i in range(5):
        predictor.advance(STEP_S * i, 0.0)
        predictor.send(50.0)
    predictor.reset()
    predictor.advance(0.0, 7.0)
    assert predictor.predict(MODES, np.zeros(COUNT), 7.0).shaft_deg == 7.0


def test_a_loop_is_late_by_delay_latency_and_the_lag_of_its_servo():
    servo = Servo(natural_frequency_hz=10)
    timing = LoopTiming(measurement_delay_s=0.04, command_latency_s=0.01, servo=servo)
    assert timing.lateness_s == pytest.approx(0.05 + 1.4 / (20 * np.pi))
    assert LoopTiming().lateness_s == 0.0


def test_an_impossible_delay_is_refused_by_its_name():
    with pytest.raises(InvalidValue, match="measurement_delay_s"):
        LoopTiming(measurement_delay_s=-0.01)
