"""A richer law that does not show its shape may be there, and one that would show it may not."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of, scored, start_of_search

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.equivalence.told_apart import told_apart
from diagnosis.selection.equivalence.weak_forms import WeakForm, weak_forms, with_their_scores
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers

WEAK, STRONG = 3e-5, 3e-3


def dry(level):
    """A log with dry friction alone, and the candidate that names it."""
    rig = RigParameters(kinetic_n_mm_per_mm=level)
    log = joined(log_of(rig, seconds=6.0), log_of(rig, seed=1, speed=-1.0, seconds=6.0))
    state = start_of_search(log, ("coulomb_friction", "stiction"))
    start = state.problem.parameterization(("coulomb_friction",)).joined(
        {"coulomb_friction": np.log([level])}
    )
    return state, candidate(fit_effects(state.problem, ("coulomb_friction",), start))


@pytest.fixture(scope="module")
def weak():
    return dry(WEAK)


def test_a_weak_friction_may_be_stiction_and_a_strong_one_would_show_it(weak):
    for (state, best), near in ((weak, True), (dry(STRONG), False)):
        (form,) = weak_forms(state.problem, best)
        assert form.names == ("stiction",)
        assert bool(form.score - best.score < 5) is near
        if not near:
            assert form.score - best.score > 50


def test_the_score_is_the_evidence_of_all_typical_forms(weak):
    """Each fitted by itself in all but its shape: by another least squares, through the simulation.

    The level of the forms has slopes of its own there, which makes a few tenths.
    """
    state, best = weak
    problem = state.problem
    effect = problem.library["stiction"]
    parameterization = problem.parameterization(("stiction",))
    level = float(np.exp(best.fit.x[0]))
    costs = []
    for values in effect.contains["coulomb_friction"](level):
        x = parameterization.joined({**best.fit.parts, "stiction": np.log(values)})
        costs.append(_least(problem, parameterization, x))
    behind = -2 * np.log(np.mean(np.exp(-0.5 * (np.array(costs) - best.fit.cost))))
    (form,) = weak_forms(problem, best)
    assert form.score - best.score == pytest.approx(behind, abs=1.0)


def _least(problem, parameterization, x):
    """Least cost over the level of a form and all that is open beside it, by linear least squares."""

    def residual(x):
        left = np.concatenate([own[0] for own in problem.residuals([parameterization.rig(x)])])
        return np.concatenate([left, parameterization.weights * x])

    there = residual(x)
    steps = [np.array([1.0, 1.0, 0.0, *np.zeros(x.size - 3)]), *np.eye(x.size)[3:]]
    low, high = parameterization.bounds()
    inside = [np.where(np.all((x + 1e-3 * s >= low) & (x + 1e-3 * s <= high)), 1, -1) * s for s in steps]
    slopes = np.stack([(residual(x + 1e-3 * s) - there) / 1e-3 for s in inside], axis=1)
    left = there - slopes @ np.linalg.lstsq(slopes, there)[0]
    return float(left @ left)


def test_what_contains_nothing_of_the_best_has_no_weak_form(weak):
    state, _ = weak
    nominal = candidate(fit_effects(state.problem, ()))
    assert weak_forms(state.problem, nominal) == ()


@pytest.mark.parametrize(("form", "explains"), [(105.0, True), (115.0, False)])
def test_a_bound_is_nothing_against_a_law_whose_typical_forms_explain_the_log(form, explains):
    rich = scored(["stiction"], 120.0)
    bound = replace(rich.fit.status, at_bound=("stiction.stribeck",))
    rich = replace(rich, fit=replace(rich.fit, status=bound))
    weak = WeakForm(names=("stiction",), score=form, start=np.zeros(3))
    found = with_their_scores([scored(["coulomb_friction"], 100.0), rich], [weak])
    assert next(c for c in found if c.names == ("stiction",)).explains is explains


@pytest.mark.parametrize(("form", "expected"), [(103.0, 103.0), (100.0, 100.0), (140.0, 120.0)])
def test_the_better_of_form_and_fit_counts(form, expected):
    simple, rich = scored(["coulomb_friction"], 100.0), scored(["stiction"], 120.0)
    weak = WeakForm(names=("stiction",), score=form, start=np.zeros(3))
    first, second = with_their_scores([simple, rich], [weak])
    assert {first.names, second.names} == {("coulomb_friction",), ("stiction",)}
    assert {c.names: c.score for c in (first, second)}["stiction",] == pytest.approx(expected, abs=0.01)
    assert simple in (first, second)


def test_a_weak_dry_friction_is_undecided_with_stiction_that_nobody_tried(weak):
    state, best = weak
    found = told_apart(state.adding(([best], ())), Workers()).verdict
    assert found.kind is VerdictKind.UNDECIDED
    assert set(found.confusable) == {("coulomb_friction",), ("stiction",)}
