"""`report.json`: gap-report/1, the contract with other programs (docs/gap-report.md)."""

import math
from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

from pydantic_core import to_jsonable_python

from diagnosis.assessment.identifiability import unidentifiable
from diagnosis.assessment.nearest import Nearest
from diagnosis.assessment.sensor_errors import SensorErrors
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.assessment.uncertainty.joint_uncertainty import JointUncertainty
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import Fit
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.likeness.likeness import likeness_of
from diagnosis.freeform.missing.missing import Dependence, Missing
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.report.sentences.names import explanation_name
from diagnosis.residuals.residual_breakdown import ResidualBreakdown
from diagnosis.residuals.residual_shape import ResidualShape
from diagnosis.result import Diagnosis
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.record import RecordEntry
from diagnosis.selection.verdicts.verdict import Verdict
from diagnosis.stopping import EarlyStop

FORMAT = "gap-report/1"


def as_json(diagnosis: Diagnosis) -> dict[str, Any]:
    """Every key of gap-report/1, plain values."""
    verdict, assessment = diagnosis.verdict, diagnosis.assessment
    missing = {"missing": _missing(diagnosis.missing)} if diagnosis.missing else {}
    return {
        "format": FORMAT,
        "verdict": verdict.kind.value,
        "stopped": _stopped(diagnosis.stopped),
        "effects": list(verdict.effects),
        "confusable": [list(names) for names in verdict.confusable],
        "ranking": [_ranked(names, probability) for names, probability in verdict.ranking],
        "parameters": _parameters(assessment.parameters),
        "covariance": _covariance(assessment.joint),
        "gap": {**asdict(assessment.gap), "noise": 1.0},
        "nearest": _nearest(assessment.nearest, verdict),
        **missing,
        "sensors": _sensors(assessment.sensors),
        "where": _where(diagnosis),
        "next_experiment": assessment.next_experiment,
        "floor": _floor(verdict.best),
        "fit": _fit(verdict.best.fit),
        "further": assessment.with_one_more,
        "hidden": {name: dict(limit.parameters) for name, limit in assessment.detection_limits.items()},
        "beside_hidden": {name: limit.beside for name, limit in assessment.detection_limits.items()},
        "cannot_tell": list(unidentifiable(diagnosis.log)),
        "replay_error": assessment.numerical_error,
        "rig": diagnosis.log.stated_rig.model_dump(mode="json"),
        "noise": dict(diagnosis.noise.sigma),
        "noise_colour": {
            s: {"share": own.share, **own.numbers()} for s, own in diagnosis.noise.colour.items()
        },
        "search": [_entry(entry) for entry in diagnosis.record],
        "warnings": list(diagnosis.warnings),
    }


def _ranked(names: tuple[str, ...], probability: float) -> dict[str, Any]:
    """A row of the ranking: a set of effects is one, under a name of its own."""
    effects = [name for name in names if name in LIBRARY]
    return {"effect": explanation_name(names), "effects": effects, "probability": probability}


def _stopped(early: EarlyStop | None) -> dict[str, Any] | None:
    if early is None:
        return None
    return {"why": early.why, "stage": early.stage, "left_out": list(early.left_out)}


def _parameters(by_effect: Mapping[str, Mapping[str, Interval]]) -> dict[str, Any]:
    return {
        effect: {name: asdict(interval) for name, interval in own.items()}
        for effect, own in by_effect.items()
    }


def _covariance(joint: JointUncertainty) -> dict[str, Any]:
    """How the parameters of the nearest explanation are uncertain together, in their units."""
    return {
        "parameters": list(joint.names),
        "values": joint.told.tolist(),
        "bounds": [[p.low, p.high] for p in joint.parameters],
        "matrix": joint.covariance_of_values.tolist(),
    }


def _nearest(nearest: Nearest, verdict: Verdict) -> dict[str, Any]:
    """The best that was tried, whatever the verdict."""
    return {
        "effects": list(nearest.effects),
        "parameters": _parameters(nearest.parameters),
        "gap_after": nearest.gap_after,
        "power_explained_percent": nearest.power_explained_percent,
        "at_bound": list(nearest.at_bound),
        "imperfections": list(nearest.imperfections),
        "as_near": [list(names) for names in verdict.as_near],
        "by_trial": [{**asdict(own), "differs": own.differs} for own in nearest.by_trial],
        "by_motion": [{**asdict(own), "differs": own.differs} for own in nearest.by_motion],
    }


def _missing(missing: Missing) -> dict[str, Any]:
    """What is not in the library."""
    law = missing.law
    return {
        "place": {place.value: p for place, p in missing.place.items()},
        "depends_on": [_dependence(one) for one in missing.depends_on],
        "law": None if law is None else _lists(asdict(law)),
        "laws_beside": [_lists(asdict(other)) for other in missing.beside],
        "looks_like": _looks_like(law),
        "closed": missing.closed,
        "determined_share": missing.determined_share,
    }


def _looks_like(law: Law | None) -> dict[str, Any] | None:
    like = likeness_of(law) if law else None
    return _lists(asdict(like)) if like else None


def _dependence(one: Dependence) -> dict[str, Any]:
    return {
        "variable": str(one.variable),
        "gap_after": one.gap_after if math.isfinite(one.gap_after) else None,
        "place": one.place.value,
        "title": one.title,
        "decimated": one.decimated,
    }


def _lists(law: dict[str, Any]) -> dict[str, Any]:
    """Plain values, with lists in place of tuples."""
    plain: dict[str, Any] = to_jsonable_python(law)
    return plain


def _sensors(errors: SensorErrors) -> dict[str, Any]:
    return {
        "imperfections": _parameters(errors.imperfections),
        "torque_drift_sigma": errors.drift_sigma[TORQUE],
        "tip_drift_sigma": errors.drift_sigma[TIP],
        "clock_starts": [asdict(clock) for clock in errors.clock_starts],
        "reading_jumps": [asdict(jump) for jump in errors.reading_jumps],
    }


def _where(diagnosis: Diagnosis) -> dict[str, Any]:
    """The residual of the nominal rig, and of what the best explanation leaves."""
    assessment, effects = diagnosis.assessment, diagnosis.verdict.effects
    return {
        **_parts(assessment.breakdown, assessment.shape),
        "place": LIBRARY[effects[0]].place.value if effects else "",
        "after": _parts(assessment.breakdown_after, assessment.shape_after),
    }


def _parts(breakdown: ResidualBreakdown, shape: ResidualShape) -> dict[str, Any]:
    """Both records as they are; which signal leads only where that is certain."""
    certain = shape if shape.leads and shape.leads.signal else replace(shape, leads=None)
    parts: dict[str, Any] = to_jsonable_python({**asdict(breakdown), **asdict(certain)})
    return parts


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
        "presliding_deg": fit.parameterization.base.presliding_deg,
    }


def _entry(entry: RecordEntry) -> dict[str, Any]:
    return {**asdict(entry), "effects": list(entry.effects), "decision": entry.decision.value}
