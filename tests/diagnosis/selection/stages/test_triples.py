"""Three effects are tried where no two explain the log."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import concluded, log_of, scored, start_of_search

from diagnosis.criteria import TRIPLE_BASES
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.search import search
from diagnosis.selection.stages import triples as module
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdict import VerdictKind
from diagnosis.workers import Workers

EFFECTS = ("coulomb_friction", "tip_drag", "torque_bias", "entry_friction", "stiction")


def asked_for(state, monkeypatch, *, explained, pairs):
    """The sets that are screened."""
    monkeypatch.setattr(SearchState, "rechecked", lambda own: (own, explained))
    asked = []

    def screen_all(stage, calls, workers):
        asked.extend((*base.names, name) for _, base, name in calls)
        return [], ()

    monkeypatch.setattr(module, "screen_all", screen_all)
    module.triples(replace(state, effects=EFFECTS, pairs=pairs), Workers())
    return asked


def test_every_other_effect_is_tried_beside_the_leading_pairs_alone(still_start, monkeypatch):
    last = [scored(["tip_drag", "stiction"], 9.0)]
    first = [scored(["tip_drag", "torque_bias"], float(i)) for i in range(TRIPLE_BASES)]
    asked = asked_for(still_start, monkeypatch, explained=False, pairs=(*last, *first))
    others = ("coulomb_friction", "entry_friction", "stiction")
    assert asked == TRIPLE_BASES * [("tip_drag", "torque_bias", other) for other in others]


@pytest.mark.parametrize("explained", [True, False])
def test_none_is_tried_where_something_explains_the_log_or_no_pair_was_fitted(
    explained, still_start, monkeypatch
):
    pairs = (scored(["tip_drag", "torque_bias"], 1.0),) if explained else ()
    assert asked_for(still_start, monkeypatch, explained=explained, pairs=pairs) == []


@pytest.mark.slow
def test_three_effects_are_found_among_others():
    rig = RigParameters(kinetic_n_mm_per_mm=0.001, tip_drag_n_mm_s_per_rad=0.15, torque_bias_n_mm=0.05)
    log = log_of(rig, speed=-1.0, seconds=8.0)
    verdict = concluded(search(start_of_search(log, EFFECTS[:4]), Workers()))
    assert verdict.kind is VerdictKind.EXPLAINED
    assert {*verdict.effects} == {*EFFECTS[:3]}
