"""Samples that an estimator may use, and those that it may not."""

import math
from dataclasses import replace

import pytest

from controllers.signals import Command, Estimate, Sample, Status

GOOD = Sample(0.0, 1.0, 0.1, 100.0, 50.0)


def test_finite_numbers_and_possible_lengths_are_usable():
    assert GOOD.usable()
    assert replace(GOOD, tip_deg=3.0).usable()
    assert replace(GOOD, inserted_mm=0.0, free_mm=0.0).usable()


@pytest.mark.parametrize(
    "field", ["time_s", "base_deg", "torque_n_mm", "inserted_mm", "free_mm", "tip_deg"]
)
@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_one_bad_number_makes_a_sample_unusable(field, bad):
    assert not replace(GOOD, **{field: bad}).usable()


@pytest.mark.parametrize("field", ["inserted_mm", "free_mm"])
def test_a_negative_length_makes_a_sample_unusable(field):
    assert not replace(GOOD, **{field: -0.1}).usable()


def test_outputs_are_good_and_unlimited_unless_they_say_otherwise():
    assert (Estimate(1.0).status, Command(1.0).status) == (Status.OK, Status.OK)
    assert Command(1.0) == Command(1.0, False, False, 0.0)
