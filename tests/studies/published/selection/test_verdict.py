"""From fits to a verdict."""

import math

import pytest
from reference_fits import fit_with

from diagnosis.replay.rig_parameters import RigParameters
from studies.published.selection.verdict import (
    VerdictKind,
    by_aicc,
    figure_verdict,
    is_consistent,
    unresolved,
)

BAD, GOOD = fit_with((), 4.0), fit_with((), 0.5)


def test_the_verdicts_are_none_explained_undecided_and_unknown():
    assert figure_verdict([GOOD], [fit_with(("a",), 0.1, parameters=2)]).kind is VerdictKind.NONE
    assert figure_verdict([BAD], [fit_with(("a",), 3.0, parameters=2)]).kind is VerdictKind.UNKNOWN
    one, other = (fit_with((n,), 0.8, parameters=2) for n in "ab")
    explained = figure_verdict([BAD], [one, fit_with(("b",), 3.0, parameters=2)])
    assert (explained.kind, explained.effects) == (VerdictKind.EXPLAINED, ("a",))
    undecided = figure_verdict([BAD], [one, other])
    assert (undecided.kind, undecided.confusable) == (VerdictKind.UNDECIDED, (("a",), ("b",)))
    assert undecided.effects == ()


def test_a_richer_form_of_an_explanation_does_not_make_it_undecided():
    one, pair = fit_with(("a",), 0.8, parameters=1), fit_with(("a", "b"), 0.6, parameters=2)
    assert figure_verdict([BAD], [one, pair]).effects == ("a",)


def test_an_explanation_that_needs_too_many_parameters_is_none():
    assert not is_consistent(fit_with(("a",), 0.0, parameters=7))
    assert is_consistent(fit_with(("a",), 0.0, parameters=5))


def test_a_fit_that_the_twist_test_contradicts_is_not_consistent():
    assert not is_consistent(
        fit_with(("a",), 0.0, parameters=1, model=RigParameters(stiffness_scale=2.0))
    )


def test_without_an_accepted_fit_the_best_one_leads_and_there_are_no_odds():
    unknown = figure_verdict([BAD], [fit_with((n,), z, parameters=2) for n, z in (("a", 4), ("b", 3))])
    assert [f.hypothesis.names for f in unknown.leading] == [("b",)]
    assert unknown.odds == 1.0


def test_odds_are_of_the_best_set_to_the_next():
    one, other = fit_with(("a",), 0.8, parameters=2), fit_with(("b",), 0.9, parameters=2)
    # Chi-square differs by 8 (0.81 - 0.64).
    assert figure_verdict([BAD], [other, one]).odds == pytest.approx(math.exp(0.5 * 8 * 0.17))
    assert min(other, one, key=by_aicc) is one


def test_figures_are_unresolved_beyond_two_standard_deviations():
    assert unresolved(fit_with((), 2.0)) == []
    assert len(unresolved(fit_with((), -2.1))) == 8
