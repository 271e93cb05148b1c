"""The record of a search."""

from dataclasses import replace

from diagnosis_fixtures import scored

from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.selection.record import (
    Decision,
    dropped,
    failed,
    judged,
    kept,
    made,
    not_fitted,
    refused,
)
from diagnosis.workers import Failure

ONE = scored(["tip_drag"], 12.5)


def test_a_candidate_that_was_made_is_told_with_how_its_fit_ended():
    (entry,) = made("single effects", [ONE])
    assert entry.reason == ONE.fit.status.message
    assert (entry.stage, entry.effects) == ("single effects", ("tip_drag",))
    assert (entry.score, entry.gap) == (12.5, 1.0)
    assert entry.decision is Decision.MADE


def test_a_candidate_that_is_kept_or_dropped_is_told_with_why():
    for record, decision in ((kept, Decision.KEPT), (dropped, Decision.DROPPED)):
        one, other = record("finalists", [ONE, replace(ONE, score=13.0)], "because")
        assert (one.decision, one.reason) == (decision, "because")
        assert other.score == 13.0


def test_what_was_not_fitted_has_no_score():
    (entry,) = not_fitted("pairs", [("tip_drag", "stiction")], "promises too little")
    assert entry.effects == ("tip_drag", "stiction")
    assert (entry.score, entry.gap) == (None, None)
    assert entry.decision is Decision.DROPPED


def test_what_failed_is_told_in_the_words_of_what_failed():
    (entry,) = failed("pairs", [Failure(effects=("stiction",), reason="lost its numbers")])
    assert (entry.effects, entry.reason) == (("stiction",), "lost its numbers")
    assert entry.decision is Decision.FAILED


def test_the_verdict_says_which_candidates_explain_the_log_and_why_others_do_not():
    good, bad = judged([scored(["tip_drag"], 1.0), scored(["stiction"], 0.5, shift=20.0)])
    assert (good.decision, good.stage) == (Decision.KEPT, "verdict")
    assert (bad.decision, bad.effects) == (Decision.DROPPED, ("stiction",))
    assert bad.reason.startswith("predictions of held-out trials shift by 20.0 times")


def test_sets_are_refused_that_no_imperfection_helps():
    above = NoiseFloor(gap=2.0, slow=5.0)
    found = [
        scored(["tip_drag"], 1.0, floor=above),
        scored(["tip_drag", "torque_clock"], 2.0),
        scored(["torque_bias"], 3.0, floor=above),
    ]
    assert refused(judged(found)) == {frozenset({"torque_bias"})}
    assert refused(made("elsewhere", found)) == frozenset()
