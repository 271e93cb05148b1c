"""What is told of an unknown log beside the nearest explanation."""

from types import SimpleNamespace

import pytest
from free_forms import free_fit, nothing_told

from diagnosis.freeform import unknown
from diagnosis.freeform.unknown import FREE_FORM, with_what_is_missing
from diagnosis.selection.verdict import VerdictKind
from diagnosis.stopping import StopReason, StopSignal
from diagnosis.workers import Workers
from sim.simulation import SimulationFailed

TOLD = nothing_told(nearest=SimpleNamespace(gap_after=1.01))


def missing_from(fits, monkeypatch, kind=VerdictKind.UNKNOWN, stop=None):
    """What is told where the search for laws comes to these fits, and the signal."""
    stop = StopSignal() if stop is None else stop
    monkeypatch.setattr(unknown, "free_form_fits", fits)
    verdict, workers = SimpleNamespace(kind=kind), Workers(stop=stop)
    found = with_what_is_missing(None, None, None, (), verdict, TOLD, (), workers)
    return *found, stop


@pytest.mark.parametrize("kind", [k for k in VerdictKind if k is not VerdictKind.UNKNOWN])
def test_of_a_log_that_is_not_unknown_nothing_is_looked_for(kind, monkeypatch):
    missing, told, _ = missing_from(pytest.fail, monkeypatch, kind)
    assert (missing, told) == (None, TOLD)


def test_a_law_that_does_not_help_leaves_the_assessment_as_it_is(monkeypatch):
    missing, told, _ = missing_from(lambda *_: (free_fit(1.0),), monkeypatch)
    assert missing.law is None
    assert told is TOLD


def test_a_law_that_helps_takes_the_place_of_the_nearest_explanation(monkeypatch):
    monkeypatch.setattr(unknown, "explained_by", lambda missing, *_: missing.law.title)
    missing, told, _ = missing_from(lambda *_: (free_fit(0.5, title="gap"),), monkeypatch)
    assert missing.law.title == told == "gap"


def test_after_a_stop_it_is_noted_as_left_out(monkeypatch):
    late, ended = StopSignal(), StopSignal()
    late.request(StopReason.INTERRUPTED)
    assert missing_from(pytest.fail, monkeypatch, stop=late)[:2] == (None, TOLD)

    def stopped_meanwhile(*_):
        ended.request(StopReason.INTERRUPTED)
        return (free_fit(0.5),)

    assert missing_from(stopped_meanwhile, monkeypatch, stop=ended)[:2] == (None, TOLD)
    assert late.left_out == ended.left_out == [FREE_FORM]


def test_laws_of_which_none_can_be_simulated_are_no_stop(monkeypatch):
    def failing(*_):
        raise SimulationFailed("the simulation lost its numbers")

    for fits in (failing, lambda *_: ()):
        missing, told, stop = missing_from(fits, monkeypatch)
        assert (missing, told, stop.left_out) == (None, TOLD, [])
