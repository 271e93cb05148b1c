"""The measures by which a fit is judged."""

import math

import numpy as np
import pytest
from reference_fits import LineReplay, damping_alone, fit_line, fit_with, line_figures
from scipy.stats import chi2, t

from diagnosis.effects.effect import Parameter
from studies.published.experiments.rig import PublishedRig
from studies.published.fitting.fit import chi_square_p_value, parameter_penalty, rms
from studies.published.fitting.fitter import FigureFitter
from studies.published.fitting.hypothesis import Hypothesis
from studies.published.fitting.mechanisms import DAMPING, Mechanism


def test_a_residual_is_rms_chi_square_and_p_value():
    fit = fit_with(("a",), 1.5, parameters=2)
    assert fit.rms_residual == fit.rms_left_out == 1.5
    assert fit.chi_square == pytest.approx(8 * 1.5**2)
    assert fit.p_value == pytest.approx(chi2.sf(18.0, 6))
    assert rms(np.array([3.0, 4.0])) == pytest.approx(math.sqrt(12.5))


def test_without_degrees_of_freedom_no_fit_is_consistent():
    assert chi_square_p_value(0.0, 0) == 0.0


def test_predictions_are_in_the_figures_units():
    fit = fit_with((), 2.0)
    expected = [f.value + 2 * f.sigma for f in fit.figures]
    assert fit.predicted == pytest.approx(expected)


def test_the_penalty_on_parameters_grows_as_they_approach_the_figures():
    # By hand, n = 8: k = 3 costs 6 + 24 / 4, k = 6 costs 12 + 84 / 1.
    assert parameter_penalty(8)[3] == pytest.approx(12.0)
    assert parameter_penalty(8)[6] == pytest.approx(96.0)
    assert 7 not in parameter_penalty(8)
    assert fit_with(("a",), 1.0, parameters=3).aicc == pytest.approx(8.0 + 12.0)
    assert math.isinf(fit_with(("a",), 1.0, parameters=7).aicc)


def test_intervals_contain_the_truth_as_often_as_they_say():
    rng, found = np.random.default_rng(3), []
    for _ in range(200):
        values = 0.8 * np.arange(1.0, 6.0) + rng.normal(0, 0.1, 5)
        found.append(fit_line(values, 0.1).intervals()[0])
    # Student's t with 4 degrees of freedom where sigma is known is on the safe side of
    # 95 %: 2.776 standard errors contain 99.4 %.
    inside = sum(low <= 0.8 <= high for _, low, high in found)
    assert inside >= 190
    # No wider than that makes them, in the median: then no misfit widens them.
    error = 0.1 / math.sqrt(55)
    width = np.median([high - low for _, low, high in found])
    assert width == pytest.approx(2 * t.ppf(0.975, 4) * error, rel=0.03)


def test_scatter_beyond_sigma_widens_the_interval():
    calm, wild = (fit_line(y, 0.1).intervals()[0] for y in ([1, 2, 3, 4], [2, 1, 4, 3]))
    assert wild[2] - wild[1] > 3 * (calm[2] - calm[1])


def test_a_parameter_that_no_figure_shows_has_its_whole_range_as_interval():
    invisible = Mechanism(
        name="invisible",
        place="sensor",
        parameters=(Parameter(name="p", unit="-", low=-1.0, high=2.0, start=(0.5,)),),
        apply=lambda rig, p: rig,
    )
    hypothesis = Hypothesis(names=("invisible",), base=PublishedRig(), mechanisms=(DAMPING, invisible))
    found = FigureFitter(line_figures([1.0, 2.0, 3.1], 0.1), LineReplay()).fit(hypothesis)
    assert found.intervals()[1][1:] == pytest.approx((-1.0, 2.0))


def test_a_fit_without_degrees_of_freedom_has_whole_ranges_as_intervals():
    found = FigureFitter(line_figures([0.8], 0.1), LineReplay()).fit(damping_alone())
    assert found.intervals()[0] == pytest.approx((0.8, 1e-3, 10.0), rel=1e-3)
