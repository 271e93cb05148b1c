"""How conclusions depend on the assumed standard deviation."""

import math

import pytest
from reference_fits import fit_with
from scipy.stats import chi2

from studies.published.selection.assumed_sigma import chi_square_at, consistent_sets, sigma_needed


def test_at_the_assumed_sigma_chi_square_is_that_of_the_fit():
    assert chi_square_at(fit_with((), 3.0), 0.05) == pytest.approx(72.0)


def test_the_sigma_needed_is_where_the_p_value_is_just_enough():
    fit = fit_with((), 1.9)
    needed = sigma_needed(fit)
    assert needed > 0.05
    assert chi2.sf(chi_square_at(fit, needed), 8) == pytest.approx(0.05, rel=1e-6)


def test_a_consistent_fit_needs_no_sigma_of_tables_iv_and_v_beyond_their_rounding():
    assert sigma_needed(fit_with((), 0.0)) == 0.0


def test_no_sigma_of_tables_iv_and_v_explains_table_ii():
    # Table II keeps its own: 16 x 4 of chi-square stays, above any limit for 8 figures.
    assert math.isinf(sigma_needed(fit_with((), 4.0)))


def test_sets_of_mechanisms_are_counted_once_whatever_their_free_length():
    fits = [fit_with(("a",), 0.5, parameters=1), fit_with(("a",), 0.6, parameters=1)]
    fits.append(fit_with(("b",), 4.0, parameters=1))
    assert consistent_sets(fits) == {0.03: 1, 0.05: 1, 0.1: 1, 0.2: 1}
