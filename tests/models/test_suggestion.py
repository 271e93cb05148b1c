"""Which known name was probably meant."""

import pytest

from models.suggestion import did_you_mean

KNOWN = ("least_time", "feedforward", "fig4-10cm", "fig5-10cm")


@pytest.mark.parametrize(
    ("found", "meant"),
    [("leasttime", "least_time"), ("Feed-Forward", "feedforward"), ("FIG4_10cm", "fig4-10cm")],
)
def test_the_nearest_name_is_suggested_as_it_is_spelt(found, meant):
    assert did_you_mean(found, KNOWN) == f"did you mean {meant!r}?"


@pytest.mark.parametrize("found", ["magic", "", 7, None])
def test_what_resembles_no_name_gets_no_suggestion(found):
    assert did_you_mean(found, KNOWN) == ""


def test_a_name_without_its_unit_is_answered_with_the_only_one_that_has_one():
    known = ("viscous_n_mm_s_per_mm", "kinetic_n_mm_per_mm", "kinetic_limit_n_mm_per_mm")
    assert did_you_mean("viscous", known) == "did you mean 'viscous_n_mm_s_per_mm'?"
    assert did_you_mean("kinetic", known) == ""
