"""Two imperfections of sensors, where nothing else explains a log."""

from dataclasses import replace

from diagnosis_fixtures import scored

from diagnosis.selection.stages import imperfections as module
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

ROUGH = scored(["tip_drag", "tip_clock"], 5.0)
EFFECTIVE = ("tip_drag", "tip_clock", "torque_clock", "torque_low_pass", "torque_bias")


def asked_for(state, monkeypatch, *, explained):
    """The sets that are screened."""
    monkeypatch.setattr(SearchState, "rechecked", lambda own: (own, explained))
    asked = []

    def screen_all(stage, calls, workers):
        asked.extend((*base.names, name) for _, base, name in calls)
        return [], ()

    monkeypatch.setattr(module, "screen_all", screen_all)
    state = replace(state, effects=EFFECTIVE, pairs=(ROUGH, scored(["tip_drag", "torque_bias"], 1.0)))
    module.one_more_imperfection(state, Workers())
    return asked


def test_a_second_imperfection_is_tried_beside_what_has_one(still_start, monkeypatch):
    assert asked_for(still_start, monkeypatch, explained=False) == [
        ("tip_drag", "tip_clock", "torque_clock"),
        ("tip_drag", "tip_clock", "torque_low_pass"),
    ]


def test_none_is_tried_where_something_explains_the_log(still_start, monkeypatch):
    assert asked_for(still_start, monkeypatch, explained=True) == []
