"""Detection limits of effects."""

import numpy as np
import pandas as pd
import pytest

from validation.score.detection import detection_limits, of_one_effect

ROWS = [
    ("a", 0.1, False),
    ("a", 0.2, True),
    ("a", 0.25, False),
    ("a", 0.3, False),
    ("a", 1.2, True),
    ("a", 2.0, True),
    ("b", 1.0, True),
    ("c", 0.1, False),
    ("d", 0.1, True),
    ("d", 0.2, False),
    ("a + b", 0.5, False),
]
TABLE = pd.DataFrame(ROWS, columns=["truth", "signature", "exact"]).assign(expected="explained")


def test_a_detection_limit_lies_between_what_was_not_named_and_what_was():
    found = detection_limits(TABLE)
    assert found.loc["a", "limit"] == pytest.approx(np.sqrt(0.3 * 1.2))
    assert found.loc[["b", "c", "d"], "limit"].isna().all()
    assert list(found.index) == ["a", "b", "c", "d"]


def test_the_order_of_the_logs_does_not_matter():
    assert detection_limits(TABLE[::-1]).equals(detection_limits(TABLE))


def test_pairs_unknown_signatures_and_other_verdicts_are_left_out():
    unknown = TABLE.assign(signature=[np.nan, *TABLE["signature"][1:]])
    assert len(of_one_effect(unknown)) == len(TABLE) - 2
    assert of_one_effect(TABLE.assign(expected="none")).empty


def test_limits_of_the_weak_run_are_below_the_noise(weak_run):
    limits = detection_limits(weak_run)["limit"].dropna()
    assert len(limits) >= 5
    assert limits.between(0.03, 1.0).all()
