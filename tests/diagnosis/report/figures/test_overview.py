"""The pictures of the page."""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest

from diagnosis.report.figures.overview import draw_breakdown, draw_ranking, draw_trials


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")


def test_the_breakdown_shows_nominal_and_explained_of_every_part(dry):
    figure = draw_breakdown(dry.found)
    signals = figure.axes[0]
    before, after = dry.found.assessment.breakdown, dry.found.assessment.breakdown_after
    widths = [bar.get_width() for bar in signals.patches]
    assert widths == [*before.signal.values(), *after.signal.values()]
    assert len(figure.axes) == 4


def test_the_ranking_shows_the_first_six(dry):
    axis = draw_ranking(dry.found).axes[0]
    first = dry.found.verdict.ranking[:6]
    assert [bar.get_width() for bar in axis.patches] == [p for _, p in first]
    assert [label.get_text() for label in axis.get_yticklabels()] == [name for name, _ in first]


def test_every_trial_shows_both_sensors_with_residuals_below(dry):
    one = replace(dry.found, log=replace(dry.log, trials=dry.log.trials[:1]))
    one = replace(
        one,
        nominal=one.nominal[:1],
        assessment=replace(one.assessment, explained=one.assessment.explained[:1]),
    )
    above, _, below, _ = draw_trials(one).axes
    torque = dry.log.trials[0]["base_torque_n_mm"]
    labels = {line.get_label(): line for line in above.get_lines()}
    assert set(labels) == {"measured", "nominal", "explained"}
    np.testing.assert_array_equal(labels["measured"].get_ydata(), torque)
    left = (torque - one.nominal[0]["base_torque_n_mm"]) / one.noise["base_torque_n_mm"]
    np.testing.assert_array_equal(below.get_lines()[0].get_ydata(), left)
