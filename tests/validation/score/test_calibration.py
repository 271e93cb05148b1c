"""Accuracy and calibration: closed cases, and the figures that docs/accuracy.md states."""

import numpy as np
import pandas as pd
import pytest

from validation.score.calibration import (
    calibration_error,
    calibration_error_by_chance,
    confidently_wrong,
    coverage,
    gap_left,
    reliability,
    summary,
    undetected_within_limit,
)


def table(**columns):
    return pd.DataFrame(columns)


def test_the_long_run_is_calibrated(long_run):
    """95 % intervals: of 233, 90.7 % is three standard deviations (1.43 %) below."""
    share, count = coverage(long_run)
    assert count == 233
    assert share >= 0.907
    assert calibration_error(long_run) < 0.05
    assert gap_left(long_run) > 0.95


def test_the_long_run_has_no_false_alarm_and_names_no_dry_friction_stiction(long_run):
    kinds = summary(long_run)
    assert kinds["logs"].sum() == 210
    assert kinds.loc["none", "exact"] == 1.0
    assert (kinds["exact"] >= 0.9).all()
    dry = long_run[long_run["truth"] == "coulomb_friction"]
    assert len(dry) >= 6
    assert not (dry["said"] == "stiction").any()


def test_of_older_tables_what_is_explained_or_none_and_not_exact_is_confidently_wrong():
    verdicts = ["explained", "explained", "none", "unknown", "undecided"]
    older = table(verdict=verdicts, exact=[True, False, False, False, False])
    assert list(confidently_wrong(older)) == [False, True, True, False, False]
    newer = older.assign(confidently_wrong=[False, False, True, False, False])
    assert list(confidently_wrong(newer)) == [False, False, True, False, False]


def test_summary_counts_by_kind():
    found = summary(
        table(
            kind=["single", "single", "none"],
            exact=[True, False, True],
            verdict=["explained", "undecided", "unknown"],
            seconds=[1.0, 3.0, 5.0],
        )
    )
    assert found.loc["single"].to_dict() == {
        "logs": 2,
        "confidently_wrong": 0,
        "exact": 0.5,
        "undecided": 0.5,
        "unknown": 0.0,
        "seconds": 2.0,
        "worst_seconds": 3.0,
    }


def test_coverage_is_of_all_intervals_and_nan_without_any():
    assert coverage(table(inside=[1, 2], intervals=[1, 3])) == (0.75, 4)
    share, count = coverage(table(inside=[0], intervals=[0]))
    assert np.isnan(share)
    assert count == 0


@pytest.mark.parametrize(("logs", "share"), [(400, 0.5), (100, 0.5), (100, 0.9)])
def test_by_chance_an_error_is_the_mean_distance_of_a_share_from_its_probability(logs, share):
    """Of a binomial share: sqrt(2 p (1 - p) / (pi n)); the mean of 2000 draws is good to 2 %."""
    scores = table(top_right=[False] * logs, probability=[share] * logs, probability_right=[0.0] * logs)
    expected = np.sqrt(2 * share * (1 - share) / (np.pi * logs))
    assert calibration_error_by_chance(scores) == pytest.approx(expected, rel=0.08)


def test_certain_probabilities_leave_nothing_to_chance():
    scores = table(top_right=[True] * 9, probability=[1.0] * 9, probability_right=[1.0] * 9)
    assert calibration_error_by_chance(scores) == 0.0


def test_a_calibrated_forecaster_has_no_calibration_error():
    """Of ten logs at 0.7 seven are right; said with 0.9 instead, the error is 0.2."""
    right = [True] * 7 + [False] * 3

    def error(probability):
        return calibration_error(
            table(probability=probability, probability_right=probability, top_right=right)
        )

    assert error([0.7] * 10) == pytest.approx(0.0, abs=1e-12)
    assert error([0.9] * 10) == pytest.approx(0.2)


def test_a_pair_is_predicted_with_the_probability_of_both():
    scores = table(probability=[0.5], probability_right=[0.95], top_right=[True])
    assert reliability(scores)["predicted"].iloc[0] == 0.95


def test_logs_without_a_ranking_do_not_count():
    scores = table(probability=[0.9, np.nan], probability_right=[0.9, 0.0], top_right=[True, False])
    assert reliability(scores)["logs"].sum() == 1


def test_undetected_effects_beyond_the_limit_count_against_it():
    scores = table(verdict=["none", "none", "explained"], over_hidden=[0.5, 2.0, 9.0])
    assert undetected_within_limit(scores) == (0.5, 2)


def test_the_gap_left_is_of_exact_explanations_alone():
    scores = table(
        expected=["explained"] * 3 + ["none"],
        exact=[True, True, False, True],
        gap_after=[1.0, 1.2, 1.0, 1.0],
    )
    assert gap_left(scores) == 0.5
