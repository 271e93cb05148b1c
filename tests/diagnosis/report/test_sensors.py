"""What a diagnosis says of its sensors."""

from dataclasses import replace

from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump
from diagnosis.report.sensors import imperfections

RATE = Interval(value=0.00183, low=0.0018, high=0.0019, unit="-")


def having(found, **errors):
    sensors = replace(found.assessment.sensors, **errors)
    return replace(found, assessment=replace(found.assessment, sensors=sensors))


def test_of_perfect_sensors_nothing_is_said(dry):
    assert imperfections(dry.found) == ""


def test_each_imperfection_is_told_with_its_value(dry):
    found = having(dry.found, imperfections={"torque_clock": {"rate": RATE}})
    assert imperfections(found) == (
        "The sensors are not perfect; the diagnosis allows for this: a clock of the torque sensor that "
        "drifts, rate 0.00183 (95 % interval 0.0018 to 0.0019)"
    )


def test_a_drift_is_told_with_its_sensor_and_range(dry):
    found = having(dry.found, drift_sigma={TORQUE: 2.345, TIP: 0.0})
    assert "drift of the torque sensor, by up to 2.35 σ (0.023 N mm) within a trial" in imperfections(
        found
    )
    assert "tip" not in imperfections(found)
    found = having(dry.found, drift_sigma={TORQUE: 0.0, TIP: 4.2})
    assert "drift of the tip sensor, by up to 4.20 σ (" in imperfections(found)
    assert " deg) within a trial" in imperfections(found)
    assert "torque" not in imperfections(found)


def test_clocks_that_ran_before_are_told_by_sensor_and_trial(dry):
    each = (("tip_angle_deg", "trial_01.csv", 2.546), ("tip_angle_deg", "trial_02.csv", 0.0))
    clocks = tuple(ClockStart(trial=trial, sensor=sensor, before_s=s) for sensor, trial, s in each)
    said = imperfections(having(dry.found, clock_starts=clocks))
    assert said.endswith(
        ": the clock of the tip sensor ran for 2.55 s before trial_01.csv, 0 s before trial_02.csv"
    )


def test_a_jump_is_told_with_its_size_time_and_trial(dry):
    jump = ReadingJump(trial="trial_02.csv", sensor="tip_angle_deg", time_s=7.38, size=1.0234)
    said = imperfections(having(dry.found, reading_jumps=(jump,)))
    assert "a jump of tip_angle_deg by +1.02 deg at 7.38 s in trial_02.csv" in said
    torque = replace(jump, sensor="base_torque_n_mm", size=-0.05)
    assert "by -0.05 N mm" in imperfections(having(dry.found, reading_jumps=(torque,)))
