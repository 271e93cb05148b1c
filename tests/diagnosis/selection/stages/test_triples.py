"""Three effects are tried where no two explain the log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import concluded, fit_of, log_of, scored, sets_screened, start_of_search

from diagnosis.criteria.selection import (
    NEAR_FLOOR,
    SECOND_LEAVES,
    SIMPLE_LEAD,
    TRIPLE_BASES,
    TRIPLE_SHARE,
    WORTH_FITTING,
)
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.screening import Screened
from diagnosis.selection.search import search
from diagnosis.selection.stages import triples as module
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers

LEADING = ("tip_drag", "coulomb_friction", "entry_friction", "stiction")
EFFECTS = ("coulomb_friction", "tip_drag", "torque_bias", "entry_friction", "stiction")


def asked_for(state, monkeypatch, *, explained, pairs):
    """The sets that are screened."""
    state = replace(state, effects=EFFECTS, pairs=pairs)
    return sets_screened(module.three_effects, state, monkeypatch, explained=explained)


def _with_others(*pair):
    """A pair with every other effect, but for one that contains one of it."""
    apart = (
        ({"stiction", "coulomb_friction"} - {*pair})
        if {*pair} & {"stiction", "coulomb_friction"}
        else set()
    )
    return [(*pair, other) for other in EFFECTS if other not in (*pair, *apart)]


@pytest.mark.parametrize("promising", [True, False])
def test_every_other_effect_is_tried_beside_the_leading_pairs_alone_if_one_promises_enough(
    promising, still_start, monkeypatch
):
    last = [scored(["tip_drag", "stiction"], 9.0)]
    first = [scored([name, "torque_bias"], 1.0) for name in LEADING]
    state = replace(still_start, effects=EFFECTS, pairs=(*last, *first))
    asked = []

    def screened(_stage, calls, _workers):
        asked.extend((*base.names, name) for _, base, name in calls)
        return [Screened(names=asked[-1], start=np.zeros(3), cost=0.0, gain=0.0)], ()

    monkeypatch.setattr(module, "screen_all", screened)
    monkeypatch.setattr(module, "_worth_a_third", lambda *_, explained: promising)
    monkeypatch.setattr(module, "fit_screened", lambda *_: ([], ()))
    monkeypatch.setattr(type(state), "rechecked", lambda own: (own, False))
    module.three_effects(state, Workers())
    assert len(LEADING) == TRIPLE_BASES
    leading = [names for name in LEADING for names in _with_others(name, "torque_bias")]
    assert asked == leading + ([] if promising else _with_others("tip_drag", "stiction"))


def test_nothing_is_tried_beside_a_pair_that_leaves_far_more_than_the_best(still_start, monkeypatch):
    near, far = (scored([name, "torque_bias"], 1.0) for name in ("tip_drag", "stiction"))
    near = replace(near, fit=replace(near.fit, cost=50.0))
    far = replace(far, fit=replace(far.fit, cost=1.01 * NEAR_FLOOR * 50.0))
    asked = asked_for(still_start, monkeypatch, explained=False, pairs=(near, far))
    assert {names[:2] for names in asked} == {("tip_drag", "torque_bias")}


@pytest.mark.parametrize(
    ("explained", "cost", "gain", "worth"),
    [
        (False, 2000.0 - 1.01 * TRIPLE_SHARE * 1000.0, WORTH_FITTING, True),
        (False, 2000.0 - 0.99 * TRIPLE_SHARE * 1000.0, WORTH_FITTING, False),
        (False, 1000.0, 0.9 * WORTH_FITTING, False),
        (True, 0.999 * SECOND_LEAVES * 2000.0, 0.0, True),
        (True, 1.001 * SECOND_LEAVES * 2000.0, WORTH_FITTING, False),
    ],
)
def test_a_third_effect_has_to_promise_its_share_of_what_the_pair_leaves(explained, cost, gain, worth):
    pair = fit_of(("tip_drag", "torque_bias"), by_trial=[np.full(1000, np.sqrt(2.0))])
    three = ("tip_drag", "torque_bias", "stiction")
    one = Screened(names=three, start=np.zeros(3), cost=cost, gain=gain)
    assert pair.cost == pytest.approx(2000.0)
    assert module._worth_a_third(one, pair, explained=explained) is worth


def test_beside_a_pair_that_explains_the_log_every_other_effect_is_tried(still_start, monkeypatch):
    best = scored(["torque_bias", "tip_drag"], 1.0)
    behind = scored(["torque_bias", "stiction"], 1.1 * SIMPLE_LEAD + 2.0)
    state = replace(still_start, candidates=(best,))
    pairs = (behind, scored(["tip_drag", "torque_bias"], 2.0))
    asked = asked_for(state, monkeypatch, explained=True, pairs=pairs)
    others = ("coulomb_friction", "entry_friction", "stiction")
    assert asked == [("tip_drag", "torque_bias", other) for other in others]


def test_what_is_as_likely_as_the_pair_that_explains_the_log_may_be_a_part_too(still_start, monkeypatch):
    state = replace(still_start, candidates=(scored(["tip_drag", "torque_bias"], 1.0),))
    pairs = (scored(["entry_friction", "torque_bias"], 1.5), scored(["tip_drag", "torque_bias"], 2.0))
    asked = asked_for(state, monkeypatch, explained=True, pairs=pairs)
    assert {names[:2] for names in asked} == {pair.names for pair in pairs}


@pytest.mark.parametrize("explained", [True, False])
def test_none_is_tried_where_one_effect_explains_the_log_or_no_pair_was_fitted(
    explained, still_start, monkeypatch
):
    state = replace(still_start, candidates=(scored(["tip_drag"], 1.0),))
    pairs = (scored(["tip_drag", "torque_bias"], 2.0),) if explained else ()
    assert asked_for(state, monkeypatch, explained=explained, pairs=pairs) == []


@pytest.mark.parametrize(("exponent", "finalists"), [(0.98, 1), (0.995, 0)])
def test_three_of_which_one_is_as_good_as_none_are_not_fitted_to_the_log(
    exponent, finalists, still_start, monkeypatch
):
    names = ("tip_drag", "torque_bias", "shear_thinning")
    three = scored(names, 1.0)
    own = three.fit.parameterization
    told = [f"{o}.{p.name}" for o, p in zip(own.owners, own.parameters, strict=True)]
    x, at = three.fit.x.copy(), told.index("shear_thinning.exponent")
    x[at] = own.parameters[at].to_fit(exponent)
    three = replace(three, fit=replace(three.fit, x=x))
    asked = []
    monkeypatch.setattr(module, "screen_all", lambda *_: ([], ()))
    monkeypatch.setattr(module, "fit_screened", lambda *_: ([three], ()))
    monkeypatch.setattr(
        module, "fit_finalists", lambda _, __, found, ___: (asked.extend(found), ([], ()))[1]
    )
    monkeypatch.setattr(type(still_start), "rechecked", lambda state: (state, False))
    found = module.three_effects(still_start, Workers())
    assert len(asked) == finalists
    assert len(found.triples) == finalists
    assert sum("as good as none" in entry.reason for entry in found.record) == 1 - finalists


@pytest.mark.slow
def test_three_effects_are_found_among_others():
    rig = RigParameters(kinetic_n_mm_per_mm=0.001, tip_drag_n_mm_s_per_rad=0.15, torque_bias_n_mm=0.05)
    log = log_of(rig, speed=-1.0, seconds=8.0)
    verdict = concluded(search(start_of_search(log, EFFECTS[:4]), Workers()))
    assert verdict.kind is VerdictKind.EXPLAINED
    assert {*verdict.effects} == {*EFFECTS[:3]}
