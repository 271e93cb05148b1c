"""What the pictures have in common."""

from diagnosis.log.trial import SENSORS
from diagnosis.report.figures.style import LABELS, MEASURED, PREDICTIONS


def test_every_sensor_has_a_label_and_every_line_its_own_colour():
    assert set(LABELS) == set(SENSORS)
    assert list(PREDICTIONS) == ["nominal", "explained"]
    assert len({MEASURED, *PREDICTIONS.values()}) == 3
