"""The record of a search: which stage made, kept or dropped which explanation, and why."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from diagnosis.effects import LIBRARY
from diagnosis.selection.candidate import Candidate
from diagnosis.workers import Failure

_VERDICT = "verdict"


class Decision(StrEnum):
    """What happened to an explanation."""

    MADE = "made"
    KEPT = "kept"
    DROPPED = "dropped"
    FAILED = "failed"
    STOPPED = "stopped"


@dataclass(frozen=True, kw_only=True)
class RecordEntry:
    """One decision of one stage.

    Attributes:
      effects: of the explanation; none: the nominal rig.
      reason: why, in words.
      score: of a candidate that was fitted; None: it was not.
      gap: root mean square of its residual / sigma; None likewise.
    """

    stage: str
    effects: tuple[str, ...]
    decision: Decision
    reason: str
    score: float | None = None
    gap: float | None = None


def made(stage: str, candidates: Iterable[Candidate]) -> tuple[RecordEntry, ...]:
    """Candidates that a stage fitted, with how their fits ended."""
    return tuple(_entry(stage, c, Decision.MADE, c.fit.status.message) for c in candidates)


def kept(stage: str, candidates: Iterable[Candidate], reason: str) -> tuple[RecordEntry, ...]:
    """Candidates that a stage keeps."""
    return tuple(_entry(stage, c, Decision.KEPT, reason) for c in candidates)


def dropped(stage: str, candidates: Iterable[Candidate], reason: str) -> tuple[RecordEntry, ...]:
    """Candidates that a stage drops."""
    return tuple(_entry(stage, c, Decision.DROPPED, reason) for c in candidates)


def noted(stage: str, decision: Decision, reason: str) -> RecordEntry:
    """A decision of a stage on no single explanation."""
    return RecordEntry(stage=stage, effects=(), decision=decision, reason=reason)


def not_fitted(stage: str, sets: Iterable[tuple[str, ...]], reason: str) -> tuple[RecordEntry, ...]:
    """Sets of effects that a stage drops before a fit."""
    return tuple(
        RecordEntry(stage=stage, effects=names, decision=Decision.DROPPED, reason=reason)
        for names in sets
    )


def judged(candidates: Iterable[Candidate]) -> tuple[RecordEntry, ...]:
    """What the verdict rests on: which candidates explain the log, and why others do not."""
    return tuple(
        _entry(_VERDICT, c, Decision.DROPPED, c.objection)
        if c.objection
        else _entry(_VERDICT, c, Decision.KEPT, "at the noise floor, on held-out trials too")
        for c in candidates
    )


def refused(record: Iterable[RecordEntry]) -> frozenset[frozenset[str]]:
    """Sets of effects that do not explain the log, whatever imperfection of a sensor is beside them."""
    sets: dict[Decision, set[frozenset[str]]] = {Decision.KEPT: set(), Decision.DROPPED: set()}
    for entry in record:
        if entry.stage == _VERDICT and entry.score is not None:
            effects = frozenset(name for name in entry.effects if name in LIBRARY)
            sets[entry.decision].add(effects)
    return frozenset(sets[Decision.DROPPED] - sets[Decision.KEPT])


def failed(stage: str, failures: Iterable[Failure]) -> tuple[RecordEntry, ...]:
    """What a stage could not simulate, or had no time for."""
    return tuple(
        RecordEntry(
            stage=stage,
            effects=f.effects,
            decision=Decision.STOPPED if f.stopped else Decision.FAILED,
            reason=f.reason,
        )
        for f in failures
    )


def _entry(stage: str, one: Candidate, decision: Decision, reason: str) -> RecordEntry:
    return RecordEntry(
        stage=stage,
        effects=one.names,
        decision=decision,
        reason=reason,
        score=one.score,
        gap=one.floor.gap,
    )
