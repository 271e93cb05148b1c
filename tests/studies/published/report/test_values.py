"""Values as text."""

from studies.published.experiments.figures import plastisol
from studies.published.report.values import (
    deviation_text,
    fitted_values,
    names_in_words,
    percent,
    value_text,
    with_free_length,
)


def test_a_turn_that_does_not_settle_is_said_to_take_longer_than_it_was_observed():
    settling, integral = plastisol()[5], plastisol()[7]
    assert value_text(settling, 2.999) == "3"
    assert value_text(settling, 3.5) == "> 3"
    assert value_text(integral, 61.148) == "61.1"


def test_sets_of_mechanisms_and_shares_are_said_in_words(study):
    assert names_in_words(()) == "nothing"
    assert names_in_words(("a", "b")) == "a and b"
    assert (percent(0.056, 1), percent(0.3)) == ("5.6 %", "30 %")
    assert deviation_text(6.507) == "6.5 mm"
    (alone,) = study.plastisol.singles()
    assert with_free_length(alone) == "base_servo (no free length)"


def test_fitted_values_have_units_and_lie_within_their_intervals(study):
    best = fitted_values(study.plastisol.verdict.best)
    assert list(best) == ["damping_error", "base_servo", "shear_thinning"]
    assert best["base_servo"]["time"]["unit"] == "s"
    for parameters in best.values():
        assert all(p["low"] <= p["value"] <= p["high"] for p in parameters.values())
