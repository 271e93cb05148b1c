"""Another effect in place of one of those that nearly explain a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, joined, log_of, scored, sets_screened, start_of_search

from diagnosis.criteria.selection import EXCHANGE_GAP
from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import dropped
from diagnosis.selection.stages.exchange import (
    IN_THE_BEST,
    STAGE,
    exchanges,
    exchanges_in_the_best,
)
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

EFFECTS = ("coulomb_friction", "entry_friction", "base_compliance", "tip_drag", "stiction")
PAIR = ("coulomb_friction", "base_compliance")
TRUE = {"entry_friction", "base_compliance"}
SAMPLES = 1000


def fit_near(problem, names, *values, **options):
    """A fit of effects of one parameter each, from near values."""
    own = problem.parameterization(names)
    each = zip(names, own.parameters, values, strict=False)
    start = own.joined({name: np.array([p.to_fit(value)]) for name, p, value in each})
    return fit_effects(problem, names, start, **options)


def leaving(names, gap):
    """A candidate with that gap, of a fit that nobody made."""
    return replace(scored(names, 1.0), fit=fit_of(names, by_trial=[np.full(SAMPLES, gap)]))


def asked_for(state, monkeypatch, *candidates, explained=False):
    """The sets that are screened, each after the fit of a smaller one."""
    module = exchanges.__globals__
    monkeypatch.setitem(
        module, "fit_all", lambda _, calls, __: ([leaving(names, 1.2) for _, names, _ in calls], ())
    )
    state = replace(state, effects=EFFECTS, candidates=candidates)
    return sets_screened(exchanges, state, monkeypatch, explained=explained)


def test_each_effect_of_the_leading_set_is_exchanged_for_every_other(still_start, monkeypatch):
    asked = asked_for(still_start, monkeypatch, leaving(PAIR, 1.2))
    drag = [("coulomb_friction", name) for name in ("entry_friction", "tip_drag")]
    friction = [("base_compliance", name) for name in ("entry_friction", "tip_drag", "stiction")]
    assert asked == friction + drag


def test_an_imperfection_of_a_sensor_stays(still_start, monkeypatch):
    asked = asked_for(still_start, monkeypatch, leaving((*PAIR, "torque_low_pass"), 1.2))
    assert asked
    assert all("torque_low_pass" in names[:-1] for names in asked)


def test_no_set_is_asked_for_beside_which_all_were_tried(still_start, monkeypatch):
    tried = replace(
        still_start, record=dropped("pairs", [scored(("base_compliance", "tip_drag"), 9.0)], "tried")
    )
    asked = asked_for(tried, monkeypatch, leaving(PAIR, 1.2))
    assert {names[:-1] for names in asked} == {("coulomb_friction",)}


@pytest.mark.parametrize(
    ("names", "gap", "explained"),
    [
        (PAIR, 1.2, True),
        (PAIR, 1.01 * EXCHANGE_GAP, False),
        (("coulomb_friction",), 1.2, False),
        (("coulomb_friction", "torque_low_pass"), 1.2, False),
    ],
)
def test_none_is_where_the_log_is_explained_or_far_from_it_or_one_effect_leads(
    names, gap, explained, still_start, monkeypatch
):
    asked = asked_for(still_start, monkeypatch, leaving(names, gap), explained=explained)
    assert asked == []


@pytest.mark.slow
def test_friction_at_the_entry_is_found_where_friction_along_the_shaft_led():
    rig = RigParameters(entry_friction_n_mm=0.03, base_stiffness_n_mm_per_rad=20.0)
    log = joined(*(log_of(rig, seed=i) for i in range(2)))
    state = start_of_search(log, effects=EFFECTS)
    state = replace(state, candidates=(candidate(fit_near(state.problem, PAIR, 3e-4, 20.0)),))
    assert 1.05 < state.best.fit.gap < EXCHANGE_GAP
    found = exchanges(state, Workers())
    assert {*found.best.names} == TRUE
    assert found.rechecked()[1]
    assert {entry.stage for entry in found.record} == {STAGE, f"finalists, {STAGE}"}


@pytest.mark.slow
def test_a_set_that_is_right_is_left_as_it_is():
    """Its fit ended early, so that it does not explain the log; nothing else fits better."""
    rig = RigParameters(kinetic_n_mm_per_mm=0.003, base_stiffness_n_mm_per_rad=20.0)
    log = joined(*(log_of(rig, seed=i) for i in range(2)))
    state = start_of_search(log, effects=EFFECTS)
    early = fit_near(state.problem, PAIR, 2.5e-3, 18.0, most_iterations=1)
    state = replace(state, candidates=(candidate(early),))
    assert {*exchanges(state, Workers()).best.names} == {*PAIR}


@pytest.mark.slow
@pytest.mark.parametrize("true", [TRUE, {*PAIR}])
def test_what_does_better_than_a_set_that_explains_the_log_is_found(true):
    """Friction at the entry is so weak that friction along the shaft imitates it to the noise."""
    weak = {"entry_friction_n_mm": 0.006} if true == TRUE else {"kinetic_n_mm_per_mm": 2e-4}
    rig = RigParameters(base_stiffness_n_mm_per_rad=20.0, **weak)
    log = joined(*(log_of(rig, seed=i) for i in range(2)))
    state = start_of_search(log, effects=EFFECTS)
    state = replace(state, candidates=(candidate(fit_near(state.problem, PAIR, 2e-4, 20.0)),))
    state, explained = state.rechecked()
    assert explained
    found = exchanges_in_the_best(state, Workers())
    assert {*found.best.names} == true
    stages = {entry.stage for entry in found.record[len(state.record) :]}
    assert stages <= {IN_THE_BEST, f"finalists, {IN_THE_BEST}"}


@pytest.mark.parametrize(
    ("names", "explained", "asks"),
    [(PAIR, True, True), (PAIR, False, False), (("coulomb_friction",), True, False)],
)
def test_another_effect_is_asked_for_in_a_set_that_explains_the_log(
    names, explained, asks, still_start, monkeypatch
):
    monkeypatch.setattr(SearchState, "at_the_floor", lambda *_: True)
    state = replace(still_start, effects=EFFECTS, candidates=(scored(names, 1.0),))
    asked = sets_screened(exchanges_in_the_best, state, monkeypatch, explained=explained)
    assert bool(asked) is asks
    assert all(len(names) == len(PAIR) and {*names} != {*PAIR} for names in asked)
