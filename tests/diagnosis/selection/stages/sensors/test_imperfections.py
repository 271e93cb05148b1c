"""Two imperfections of sensors, where nothing else explains a log."""

from dataclasses import replace

from diagnosis_fixtures import scored, sets_screened

from diagnosis.criteria import NEAR_FLOOR
from diagnosis.selection.stages.sensors import imperfections as module

ROUGH = scored(["tip_drag", "tip_clock"], 5.0)
EFFECTIVE = ("tip_drag", "tip_clock", "torque_clock", "torque_low_pass", "torque_bias")


def asked_for(state, monkeypatch, *, explained):
    """The sets that are screened."""
    state = replace(state, effects=EFFECTIVE, pairs=(ROUGH, scored(["tip_drag", "torque_bias"], 1.0)))
    return sets_screened(module.one_more_imperfection, state, monkeypatch, explained=explained)


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
    run = module.one_more_imperfection
    assert sets_screened(run, state, monkeypatch, explained=False) == []
    near = replace(state, pairs=(replace(ROUGH, fit=replace(ROUGH.fit, cost=0.99 * NEAR_FLOOR * 50.0)),))
    assert sets_screened(run, near, monkeypatch, explained=False)


def test_none_is_tried_where_something_explains_the_log(still_start, monkeypatch):
    assert asked_for(still_start, monkeypatch, explained=True) == []
