"""What the pictures have in common."""

import numpy as np
from matplotlib.colors import to_rgb

from diagnosis.log.trial import SENSORS
from diagnosis.report.figures.style import (
    HATCHES,
    LABELS,
    LINES,
    MEASURED,
    PREDICTIONS,
    block_means,
    rms,
)


def lightness(colour):
    """Relative luminance, 0 to 1 (WCAG 2)."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def test_every_sensor_has_a_label_and_every_line_its_own_colour():
    assert set(LABELS) == set(SENSORS)
    assert list(PREDICTIONS) == ["nominal", "explained"]
    assert len({MEASURED, *PREDICTIONS.values()}) == 3


def test_nominal_and_explained_differ_without_colour():
    assert len(set(LINES.values())) == len(set(HATCHES.values())) == 2
    nominal, explained = (lightness(PREDICTIONS[name]) for name in ("nominal", "explained"))
    assert (nominal + 0.05) / (explained + 0.05) > 2


def test_means_over_blocks_are_at_most_so_many_and_the_last_may_be_shorter():
    np.testing.assert_array_equal(block_means(np.arange(7.0), 3), [1.0, 4.0, 6.0])
    np.testing.assert_array_equal(block_means(np.arange(3.0), 3), [0.0, 1.0, 2.0])
    assert block_means(np.zeros(0), 3).size == 0


def test_the_root_mean_square_leaves_out_what_was_not_read():
    assert rms([np.array([3.0, np.nan]), np.array([-3.0])]) == 3.0
    assert rms([]) == 0.0
