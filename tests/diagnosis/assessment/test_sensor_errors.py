"""Errors of sensors in an explanation."""

from diagnosis_fixtures import log_with, problem_of, trial, turns

from diagnosis.assessment.sensor_errors import sensor_errors
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.log.trial import SENSORS, TIP
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump


def test_errors_are_those_of_the_rig_and_imperfections_those_that_were_fitted():
    problem = problem_of(log_with(trial(turns(2.0))))
    clock = ClockStart(trial="trial_01.csv", sensor=TIP, before_s=0.5)
    jump = ReadingJump(trial="trial_01.csv", sensor=TIP, time_s=1.0, size=3.0)
    rig = RigParameters(clock_starts=(clock,), jumps=(jump,))
    value = Interval(value=1.0, low=0.9, high=1.1, unit="-")
    fitted = {"torque_clock": {"rate": value}, "tip_drag": {"damping": value}}
    found = sensor_errors(problem, rig, replay(problem.log, rig), fitted)
    assert found.imperfections == {"torque_clock": {"rate": value}}
    assert (found.clock_starts, found.reading_jumps) == ((clock,), (jump,))
    assert found.drift_sigma == dict.fromkeys(SENSORS, 0.0)  # none was allowed for
