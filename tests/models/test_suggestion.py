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
