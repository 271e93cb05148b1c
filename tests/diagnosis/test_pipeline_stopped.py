"""A diagnosis that is stopped tells the best so far, and no more than it knows."""

import pytest
from diagnosis_fixtures import log_of

from diagnosis import pipeline
from diagnosis.assessment.assess import TO_ITS_END
from diagnosis.pipeline import diagnose
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.report.json_report import as_json
from diagnosis.report.sentences.verdict import headline
from diagnosis.selection.record import Decision
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stages import in_words
from diagnosis.stopping import StoppedEarly, StopReason, StopSignal

DRY = RigParameters(kinetic_n_mm_per_mm=0.001)
EFFECTS = ("coulomb_friction", "tip_drag")


@pytest.fixture
def stopped_at(monkeypatch):
    """Diagnoses a small log, and interrupts it when a stage begins."""
    monkeypatch.setattr(pipeline, "testable_effects", lambda _: EFFECTS)

    def stopped(stage, rig=DRY):
        stop = StopSignal()

        def watch(news):
            if news.stage == in_words(stage):
                stop.request(StopReason.INTERRUPTED)

        return diagnose(log_of(rig, speed=-1.0, seconds=8.0), workers=1, stop=stop, progress=watch)

    return stopped


def test_a_search_that_is_cut_short_before_any_fit_tells_of_the_nominal_rig(stopped_at):
    found = stopped_at("nominal rig")
    assert found.verdict.kind is VerdictKind.UNKNOWN
    assert found.verdict.best.names == ()
    assert found.stopped.search
    assert {"single effects", "pairs"} <= set(found.stopped.left_out)
    assert found.assessment.next_experiment == TO_ITS_END
    assert headline(found).startswith(
        "Stopped early (interrupted, while fitting the nominal rig): best so far: the nominal model"
    )


def test_the_nominal_rig_at_the_floor_is_not_called_all_there_is(stopped_at):
    found = stopped_at("screening single effects", NOMINAL)
    assert (found.verdict.kind, found.verdict.confusable[0]) == (VerdictKind.UNDECIDED, ())
    assert "the nominal model as it is: undecided, because others were not tried" in headline(found)


def test_the_best_of_the_decimated_log_is_told_where_no_time_is_left_for_finalists(stopped_at):
    found = stopped_at("finalists")
    assert found.verdict.kind is VerdictKind.UNDECIDED
    assert found.verdict.effects == ("coulomb_friction",)
    level = found.assessment.parameters["coulomb_friction"]["level"]
    assert level.value == pytest.approx(0.001, rel=0.05)
    assert any(entry.decision is Decision.STOPPED for entry in found.record)
    report = as_json(found)
    assert report["stopped"]["why"] == "interrupted"
    assert report["stopped"]["stage"] == "fitting the best single effects to the whole log"
    assert report["replay_error"] == report["hidden"] == report["further"] == {}
    assert not [w for w in report["warnings"] if "not fully tried" in w]


def test_a_search_that_has_not_seen_what_is_alike_is_not_said_to_explain(stopped_at):
    found = stopped_at("what cannot be told apart")
    assert found.stopped.left_out[0] == "what cannot be told apart"
    assert (found.verdict.kind, found.verdict.effects) == (VerdictKind.UNDECIDED, ("coulomb_friction",))


def test_a_verdict_stands_where_the_assessment_alone_is_cut_short(stopped_at):
    found = stopped_at("adding another effect")
    assert (found.verdict.kind, found.verdict.effects) == (VerdictKind.EXPLAINED, ("coulomb_friction",))
    assert not found.stopped.search
    assert set(found.stopped.left_out) == {
        "adding another effect",
        "detection limits",
        "noise of the base angle in the intervals",
        "twist along the shaft",
        "next experiment",
    }
    assert found.assessment.next_experiment.startswith("add dry friction of 0.00")
    assert found.assessment.next_experiment.endswith("; then record and diagnose again")
    assert found.assessment.twist is None
    assert "best so far: Dry (Coulomb) friction along the shaft explains the gap" in headline(found)


def test_what_was_done_before_a_stop_is_not_said_to_be_left_out(stopped_at):
    """Intervals come before detection limits; in one process, twist and advice come after them."""
    found = stopped_at("detection limits")
    assert set(found.stopped.left_out) == {
        "detection limits",
        "twist along the shaft",
        "next experiment",
    }


def test_a_limit_before_the_nominal_replay_ends_is_an_error_that_says_so():
    with pytest.raises(StoppedEarly, match="limit of 0.001 s: stopped before the nominal rig"):
        diagnose(log_of(NOMINAL, seconds=2.0), workers=1, limit_s=0.001)


def test_after_a_limit_the_best_so_far_is_told():
    """All of the limit is kept for the end, so that the search has none, on any machine."""
    log = log_of(DRY, speed=-1.0)
    found = diagnose(log, workers=1, stop=StopSignal(600.0, reserve_s=600.0))
    assert found.stopped.why == "limit of 600 s"
    assert found.stopped.search
    assert found.verdict.kind not in (VerdictKind.EXPLAINED, VerdictKind.NONE)
