"""What a diagnosis says of its sensors."""

from dataclasses import replace

from diagnosis.assessment.intervals import Interval
from diagnosis.report.sensors import imperfections

RATE = Interval(value=0.00183, low=0.0018, high=0.0019, unit="-")


def having(found, **told):
    return replace(found, assessment=replace(found.assessment, **told))


def test_of_perfect_sensors_nothing_is_said(dry):
    assert imperfections(dry.found) == ""


def test_each_imperfection_is_told_with_its_value(dry):
    found = having(dry.found, imperfections={"torque_clock": {"rate": RATE}})
    assert imperfections(found) == (
        "The sensors are not perfect; the diagnosis allows for this: a clock of the torque sensor that "
        "drifts, rate 0.00183 (95 % interval 0.0018 to 0.0019)"
    )


def test_a_drift_is_told_with_its_range(dry):
    found = having(dry.found, torque_drift_sigma=2.345)
    assert "drift of the torque sensor, by up to 2.35 σ within a trial" in imperfections(found)
