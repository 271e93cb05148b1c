"""Sensors and numerical error."""

from dataclasses import replace

from diagnosis.log.trial import TORQUE
from diagnosis.report.sections.sensors import sensors_section
from diagnosis.report.sentences.residual import replay_quality


def with_errors(assessment, **errors):
    return replace(assessment, sensors=replace(assessment.sensors, **errors))


def test_noise_and_numerical_error_are_told_of_each_sensor(dry):
    title, beside, lines = sensors_section(dry.found)
    assert "Sensors and numerical error" in title
    assert "noise alone" in beside
    assert all(line in lines for line in replay_quality(dry.found))


def test_what_had_to_be_allowed_for_is_told(dry):
    told = with_errors(dry.found.assessment, drift_sigma={TORQUE: 2.0})
    found = replace(dry.found, assessment=told)
    assert "a drift of the torque sensor, by up to 2.00 σ" in sensors_section(found)[1]
