"""The criteria mean what they say."""

import math

import numpy as np
from scipy.stats import norm

from studies.published import criteria
from studies.published.experiments.figures import plastisol


def test_the_levels_of_single_figures_fits_and_comparisons_agree():
    # Two standard deviations are 4.6 %; exp(6 / 2) is odds of 20 to 1, as 5 % is.
    assert abs(2 * norm.sf(criteria.RESOLVED_SIGMA) - criteria.LEAST_P_VALUE) < 0.005
    assert abs(math.exp(criteria.EQUIVALENT_AICC / 2) * criteria.LEAST_P_VALUE - 1) < 0.01


def test_chance_separates_two_equal_predictions_in_three_per_cent_of_cases():
    difference = norm.rvs(size=(2, 100_000), random_state=np.random.default_rng(0))
    separated = np.abs(difference[0] - difference[1]) > criteria.SEPARATED_SIGMAS
    # The share is 3.4 %; its own standard deviation is sqrt(0.034 / 100 000) = 0.06 %.
    assert abs(separated.mean() - 0.034) < 0.002


def test_the_assumed_sigma_is_what_the_scatter_of_table_ii_makes_of_tables_iv_and_v():
    damping = {f.depth_mm: f for f in plastisol() if f.source == "Table II"}
    relative = [damping[depth].sigma / damping[depth].value for depth in (50.0, 100.0)]
    # 10 % and 6 % at 5 and 10 cm: about 7 % of the damping, of which part shows in the figures.
    assert criteria.RELATIVE_SIGMA < np.mean(relative) < 2 * criteria.RELATIVE_SIGMA


def test_the_scan_of_sigma_has_the_assumed_one_inside():
    assert criteria.SCANNED_SIGMAS[0] < criteria.RELATIVE_SIGMA < criteria.SCANNED_SIGMAS[-1]
    assert criteria.RELATIVE_SIGMA in criteria.SCANNED_SIGMAS
