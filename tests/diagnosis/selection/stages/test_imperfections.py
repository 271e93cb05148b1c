"""Two imperfections of sensors, where nothing else explains a log."""

from dataclasses import replace

from diagnosis_fixtures import scored, sets_screened

from diagnosis.selection.stages import imperfections as module

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


def test_none_is_tried_where_something_explains_the_log(still_start, monkeypatch):
    assert asked_for(still_start, monkeypatch, explained=True) == []
