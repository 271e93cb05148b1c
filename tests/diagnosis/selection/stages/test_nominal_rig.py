"""The nominal rig is the first candidate, with its scatter where that is needed."""

from dataclasses import replace

from diagnosis_fixtures import concluded, scored

from diagnosis.selection import fitting
from diagnosis.selection.record import Decision
from diagnosis.selection.search import search
from diagnosis.selection.stages import nominal_rig as module
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed


def failing(*_, **__):
    """What cannot be simulated at all."""
    raise SimulationFailed("the simulation lost its numbers")


def test_where_the_scatter_cannot_be_fitted_the_nominal_rig_still_stands(still_start, monkeypatch):
    original = fitting.fit_effects

    def without_scatter(problem, names, *arguments):
        return original(problem, names, *arguments) if names else failing()

    monkeypatch.setattr(fitting, "fit_effects", without_scatter)
    found = search(still_start, Workers())
    assert [e.effects for e in found.record if e.decision is Decision.FAILED] == [()]
    verdict = concluded(found)
    assert verdict.kind is VerdictKind.NONE
    assert verdict.best.fit is not None
    assert verdict.best.names == ()


def test_the_verdict_is_on_the_exact_nominal_rig_where_that_is_as_good(still_start):
    found = module.nominal_rig(still_start, Workers())
    assert [c.names for c in found.candidates] == [(), ()]
    assert [e.decision for e in found.record] == [Decision.KEPT, Decision.MADE]
    verdict = concluded(found)
    assert verdict.kind is VerdictKind.NONE
    assert verdict.best.fit.x.size == 0


def test_stiffness_or_damping_alone_is_fitted_where_their_ratio_shows(monkeypatch, still_start):
    """Beside the imperfections of sensors that it has, and no set twice."""
    asked = []

    def fit_beside(stage, problem, one, sets, workers):
        asked.extend(sets)
        return [], ()

    def ratio(*names):
        ends = {"names": names, "score": 1.0, "unidentifiable": True}
        return type("Ratio", (), ends)()

    def alone(*candidates):
        asked.clear()
        module.stiffness_or_damping_alone(replace(still_start, candidates=candidates), Workers())
        return asked

    monkeypatch.setattr(module, "fit_beside", fit_beside)
    clear = scored(["tip_drag"], 0.5)
    assert alone(clear, ratio()) == []
    assert alone(ratio()) == [("stiffness_error",), ("damping_error",)]
    assert alone(ratio("tip_clock")) == [("tip_clock", n) for n in ("stiffness_error", "damping_error")]
    known = scored(["damping_error", "tip_clock"], 2.0)
    assert alone(ratio("tip_clock"), known) == [("tip_clock", "stiffness_error")]
