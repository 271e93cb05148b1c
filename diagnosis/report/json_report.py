"""`report.json`: gap-report/1, the contract with other programs (docs/gap-report.md)."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from diagnosis.assessment.identifiability import unidentifiable
from diagnosis.assessment.intervals import Interval
from diagnosis.assessment.nearest import Nearest
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import Fit
from diagnosis.result import Diagnosis
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.record import RecordEntry

FORMAT = "gap-report/1"


def as_json(diagnosis: Diagnosis) -> dict[str, Any]:
    """Every key of gap-report/1, plain values."""
    verdict, told = diagnosis.verdict, diagnosis.assessment
    return {
        "format": FORMAT,
        "verdict": verdict.kind.value,
        "effects": list(verdict.effects),
        "confusable": [list(names) for names in verdict.confusable],
        "ranking": [{"effect": n, "probability": p} for n, p in verdict.ranking],
        "parameters": _parameters(told.parameters),
        "gap": {**asdict(told.gap), "noise": 1.0},
        "nearest": _nearest(told.nearest),
        "where": _where(diagnosis),
        "next_experiment": told.next_experiment,
        "floor": _floor(verdict.best),
        "fit": _fit(verdict.best.fit),
        "further": told.with_one_more,
        "hidden": told.detection_limits,
        "cannot_tell": list(unidentifiable(diagnosis.log)),
        "replay_error": told.numerical_error,
        "noise": dict(diagnosis.noise.sigma),
        "search": [_entry(entry) for entry in diagnosis.record],
        "warnings": list(diagnosis.warnings),
    }


def _parameters(by_effect: Mapping[str, Mapping[str, Interval]]) -> dict[str, Any]:
    return {
        effect: {name: asdict(interval) for name, interval in own.items()}
        for effect, own in by_effect.items()
    }


def _nearest(nearest: Nearest) -> dict[str, Any]:
    """The best that was tried, whatever the verdict."""
    return {
        "effects": list(nearest.effects),
        "parameters": _parameters(nearest.parameters),
        "gap_after": nearest.gap_after,
        "power_explained_percent": nearest.power_explained_percent,
        "at_bound": list(nearest.at_bound),
    }


def _where(diagnosis: Diagnosis) -> dict[str, Any]:
    parts, effects = diagnosis.assessment.breakdown, diagnosis.verdict.effects
    return {
        "signal": parts.signal,
        "phase": parts.phase,
        "band_hz": [list(b) for b in parts.band_hz],
        "depth_mm": [list(d) for d in parts.depth_mm],
        "time_s": [list(t) for t in parts.time_s],
        "place": LIBRARY[effects[0]].place.value if effects else "",
    }


def _floor(best: Candidate) -> dict[str, Any]:
    """How near the noise floor the best explanation is, on fitted and on held-out trials."""
    held_out = asdict(best.held_out_floor) if best.held_out_floor else None
    return {"fitted": asdict(best.floor), "unseen": held_out, "surprise": best.shift}


def _fit(fit: Fit) -> dict[str, Any]:
    """How the fit of the best explanation ended."""
    status = fit.status
    return {
        "status": status.termination.value,
        "message": status.message,
        "at_bound": list(status.at_bound),
    }


def _entry(entry: RecordEntry) -> dict[str, Any]:
    return {**asdict(entry), "effects": list(entry.effects), "decision": entry.decision.value}
