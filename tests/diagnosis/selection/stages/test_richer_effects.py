"""What contains a leading effect is fitted from where that is."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, log_of, scored, start_of_search

from diagnosis.criteria.selection import SIMPLE_LEAD
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.fit_status import Termination
from diagnosis.fitting.held_out.cross_validation import information
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import made
from diagnosis.selection.stages import richer_effects as module
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

FALLING = RigParameters(kinetic_n_mm_per_mm=0.001, static_excess_n_mm_per_mm=0.0025, stribeck_rad_s=0.8)
"""Dry friction that falls by more than half between the slow and the fast turns of a trial."""


@pytest.fixture(scope="module")
def taken_for_constant():
    """A log with friction that falls with the rate, for which constant friction was found alone."""
    start = start_of_search(log_of(FALLING, seconds=8.0), ("coulomb_friction", "stiction"))
    fit = fit_effects(start.coarse, ("coulomb_friction",), np.array([np.log(0.002), 0, 0]))
    return replace(start, candidates=(candidate(start.nominal),), singles=(candidate(fit),))


@pytest.mark.slow
def test_what_contains_the_best_is_fitted_from_there(taken_for_constant):
    (simple,) = taken_for_constant.singles
    found = module.richer_effects(taken_for_constant, Workers())
    assert [c.names for c in found.candidates] == [(), ("stiction",)]
    assert found.pairs[0].score < simple.score - 10 * SIMPLE_LEAD
    assert found.best.floor.small
    fit = found.best.fit
    sigma = np.sqrt(np.linalg.pinv(information(fit))[0, 0])
    assert abs(fit.x[0] - np.log(0.001)) < 4 * sigma


def test_no_richer_effect_is_fitted_where_none_contains_a_leading_one(taken_for_constant):
    without = replace(taken_for_constant, effects=("coulomb_friction", "tip_drag"))
    assert module.richer_effects(without, Workers()) is without


def test_none_is_fitted_again_that_leaves_less_already_in_its_place(taken_for_constant):
    (simple,) = taken_for_constant.singles
    rich = scored(["stiction"], simple.score + 1.0)
    known = replace(rich, fit=replace(rich.fit, cost=simple.fit.cost - 1.0))
    state = replace(taken_for_constant, singles=(simple, known))
    assert module.richer_effects(state, Workers()) is state
    stalled = replace(known.fit.status, termination=Termination.STALLED)
    rough = replace(known, fit=replace(known.fit, status=stalled))
    again = replace(taken_for_constant, singles=(simple, rough))
    assert module._richer(simple, again)
    tried = again.noting(*made(module.STAGE, [rough]))
    assert not module._richer(simple, tried)
    above = replace(rich, fit=replace(rich.fit, cost=simple.fit.cost + 1.0))
    assert module._richer(simple, replace(state, singles=(simple, above))) == [
        ("coulomb_friction", "stiction")
    ]


def test_no_richer_effect_is_fitted_where_something_explains_the_log(taken_for_constant, monkeypatch):
    monkeypatch.setattr(SearchState, "rechecked", lambda state: (state, True))
    assert module.richer_effects(taken_for_constant, Workers()) is taken_for_constant


@pytest.mark.slow
def test_of_three_effects_a_richer_one_is_tried_also_where_they_explain_the_log(
    taken_for_constant, monkeypatch
):
    monkeypatch.setattr(SearchState, "rechecked", lambda state: (state, True))
    assert module.richer_effects_in_place_of_three(taken_for_constant, Workers()) is taken_for_constant
    state = replace(taken_for_constant, triples=taken_for_constant.singles)
    found = module.richer_effects_in_place_of_three(state, Workers())
    assert [c.names for c in found.candidates] == [(), ("stiction",)]


@pytest.fixture(scope="module")
def taken_for_falling():
    """A log with constant friction, for which friction that falls with the rate was found."""
    log = log_of(RigParameters(kinetic_n_mm_per_mm=0.002), seconds=8.0)
    start = start_of_search(log, ("coulomb_friction", "stiction"))
    at = np.array([np.log(0.0019), np.log(0.002), np.log(1.0)])
    fit = fit_effects(start.coarse, ("stiction",), np.concatenate([at, np.zeros(2)]))
    return replace(start, problem=start.coarse, candidates=(candidate(fit),))


def test_what_the_best_contains_is_fitted_in_its_place(taken_for_falling, monkeypatch):
    monkeypatch.setattr(SearchState, "rechecked", lambda state: (state, True))
    monkeypatch.setattr(SearchState, "at_the_floor", lambda *_: True)
    found = module.simpler_effects(taken_for_falling, Workers())
    assert found.best.names == ("coulomb_friction",)
    assert np.exp(found.best.fit.x[0]) == pytest.approx(0.002, rel=0.05)
    assert module.simpler_effects(found, Workers()) is found  # it is known by now


def test_it_begins_as_the_decimated_log_has_it_rather_in_the_same_set(taken_for_falling):
    best, dry = taken_for_falling.best, ("coulomb_friction",)
    alone, beside = (
        fit_of(names, x=x) for names, x in ((dry, [-7.0]), ((*dry, "tip_drag"), [-6.0, 0.1]))
    )
    state = replace(taken_for_falling, singles=(candidate(alone),), pairs=(candidate(beside),))
    assert module._with_simple(state, best, dry, *dry)[0] == -7.0
    assert module._with_simple(replace(state, singles=()), best, dry, *dry)[0] == -6.0


def test_nothing_simpler_is_fitted_above_the_noise(taken_for_falling, monkeypatch):
    monkeypatch.setattr(SearchState, "rechecked", lambda state: (state, False))
    monkeypatch.setattr(SearchState, "at_the_floor", lambda *_: False)
    assert module.simpler_effects(taken_for_falling, Workers()) is taken_for_falling


@pytest.mark.slow
@pytest.mark.parametrize("behind", [0.0, 2.0 * SIMPLE_LEAD])
def test_what_ended_as_the_simpler_law_is_fitted_once_more_in_the_best(
    behind, taken_for_constant, monkeypatch
):
    """But for a fit that left clearly less than the best, and so did not end there."""
    problem = taken_for_constant.coarse
    best = candidate(fit_effects(problem, ("coulomb_friction", "tip_angle_bias")))
    rich = scored(["stiction", "tip_angle_bias"], best.score + 1.0)
    rich = replace(rich, fit=replace(rich.fit, cost=best.fit.cost - behind))
    state = replace(taken_for_constant, problem=problem, candidates=(best, rich))
    monkeypatch.setattr(SearchState, "rechecked", lambda self: (self, True))
    monkeypatch.setattr(SearchState, "at_the_floor", lambda *_: True)
    found = module.richer_effects_in_the_best(state, Workers())
    least = min(c.score for c in found.candidates if "stiction" in c.names)
    assert (least < best.score - 10 * SIMPLE_LEAD) is (behind == 0.0)
