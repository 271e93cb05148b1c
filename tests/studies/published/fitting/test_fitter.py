"""Fitting hypotheses to figures."""

import numpy as np
import pytest
from reference_fits import LineReplay, damping_alone, fit_line, line_figures
from scipy.stats import chi2

from studies.published.fitting.fitter import FigureFitter


def test_a_fit_is_least_squares_and_its_left_out_figures_are_predicted_without_them():
    x, y, sigma = np.arange(1.0, 6.0), np.array([1.1, 1.9, 3.2, 3.9, 5.1]), 0.1
    found = fit_line(y, sigma)
    slope = x @ y / (x @ x)
    # A fit ends within hundredths of sigma: 0.03 of gradient moves chi-square by 1e-3.
    assert found.chi_square == pytest.approx(((slope * x - y) ** 2).sum() / sigma**2, abs=2e-3)
    assert found.degrees_of_freedom == 4
    assert found.p_value == pytest.approx(chi2.sf(found.chi_square, 4))
    for i in range(5):
        others = np.arange(5) != i
        without = x[others] @ y[others] / (x[others] @ x[others])
        # The logarithm of the scale is curved: one step of it is right to second order.
        assert found.left_out[i] == pytest.approx((without * x[i] - y[i]) / sigma, abs=0.03)


def test_the_minimum_is_searched_from_the_best_start_and_within_bounds():
    fitter = FigureFitter(line_figures([20.0, 40.0], 0.1), LineReplay())
    # The line has 20 times the stated damping; 10 times is the bound.
    x = fitter.minimum(damping_alone(), [np.array([-3.0]), np.array([1.0])])
    assert damping_alone().values(x) == pytest.approx([10.0])


def test_what_made_the_figures_is_recovered_and_a_wrong_hypothesis_is_rejected(recovery):
    # The needle of the figures is finer: a twentieth of sigma each, chi-square below 8 / 400.
    assert recovery.right.chi_square < 0.05
    value, low, high = recovery.right.intervals()[2]
    assert low < recovery.truth.model.shared_n_mm_per_mm < high
    assert value == pytest.approx(recovery.truth.model.shared_n_mm_per_mm, rel=0.03)
    assert recovery.wrong.p_value < 1e-6
