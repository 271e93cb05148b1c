"""Two imperfections of sensors beside one effect, or two, where nothing else explains a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import FITTED_SAMPLES, fit_of, scored, sets_screened

from diagnosis.criteria.selection import NEAR_FLOOR
from diagnosis.selection.candidate import candidate
from diagnosis.selection.screening import Screened
from diagnosis.selection.stages.sensors import imperfections as module
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

ROUGH = scored(["tip_drag", "tip_clock"], 5.0)
EFFECTIVE = ("tip_drag", "tip_clock", "torque_clock", "torque_low_pass", "torque_bias")


def asked_for(state, monkeypatch, *, explained):
    """The sets that are screened."""
    state = replace(state, effects=EFFECTIVE, pairs=(ROUGH, scored(["tip_drag", "torque_bias"], 1.0)))
    return sets_screened(module.imperfections_of_sensors, state, monkeypatch, explained=explained)


def test_a_second_imperfection_is_tried_beside_what_has_one(still_start, monkeypatch):
    assert asked_for(still_start, monkeypatch, explained=False) == [
        ("tip_drag", "tip_clock", "torque_clock"),
        ("tip_drag", "tip_clock", "torque_low_pass"),
    ]


def test_none_is_tried_beside_what_leaves_far_more_than_the_best(still_start, monkeypatch):
    far = replace(ROUGH, fit=replace(ROUGH.fit, cost=1.01 * NEAR_FLOOR * 50.0))
    best = scored(["tip_drag"], 1.0)
    best = replace(best, fit=replace(best.fit, cost=50.0))
    state = replace(still_start, effects=EFFECTIVE, singles=(best,), pairs=(far,))
    run = module.imperfections_of_sensors
    assert sets_screened(run, state, monkeypatch, explained=False) == []
    near = replace(state, pairs=(replace(ROUGH, fit=replace(ROUGH.fit, cost=0.99 * NEAR_FLOOR * 50.0)),))
    assert sets_screened(run, near, monkeypatch, explained=False)


def test_none_is_tried_where_something_explains_the_log(still_start, monkeypatch):
    assert asked_for(still_start, monkeypatch, explained=True) == []


def left(gap, *names):
    return candidate(fit_of(names, by_trial=[np.full(FITTED_SAMPLES, gap)]))


@pytest.mark.parametrize(
    ("best", "explained", "asked"),
    [
        (left(1.2, "tip_drag", "torque_bias", "tip_clock"), False, ["torque_clock", "torque_low_pass"]),
        (left(1.2, "tip_drag", "torque_bias", "tip_clock"), True, []),
        (left(1.2, "tip_drag", "tip_clock"), False, []),
        (left(1.6, "tip_drag", "torque_bias", "tip_clock"), False, []),
    ],
    ids=["nearly explained", "explained", "two", "far"],
)
def test_beside_three_that_nearly_explain_a_log_imperfections_and_delays_are_tried(
    best, explained, asked, still_start, monkeypatch
):
    state = replace(still_start, effects=EFFECTIVE, candidates=(best,))
    run = module.imperfections_beside_three
    found = sets_screened(run, state, monkeypatch, explained=explained)
    assert [names[-1] for names in found] == asked
    assert all(names[:-1] == best.names for names in found)


def test_of_those_beside_three_that_promise_enough_the_two_best_are_fitted(still_start, monkeypatch):
    best = left(1.2, "tip_drag", "torque_bias", "tip_clock")
    state = replace(still_start, effects=EFFECTIVE, candidates=(best,))
    costs = {"torque_clock": 30.0, "torque_low_pass": 20.0, "torque_average": 10.0}
    screened = [
        Screened(names=(*best.names, name), start=np.zeros(1), cost=cost, gain=gain)
        for name, cost in costs.items()
        for gain in (100.0, 0.1)
    ]
    monkeypatch.setattr(module, "screen_all", lambda *_: (screened, ()))
    monkeypatch.setattr(SearchState, "rechecked", lambda own: (own, False))
    fitted = []
    monkeypatch.setattr(module, "fit_all", lambda _, calls, __: (fitted.extend(calls), ([], ()))[1])
    module.imperfections_beside_three(state, Workers())
    assert [call[1][-1] for call in fitted] == ["torque_average", "torque_low_pass"]
