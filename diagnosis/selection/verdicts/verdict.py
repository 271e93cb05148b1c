"""What a diagnosis concludes: one of four verdicts, and all that it may be.

none        the nominal rig is at the noise floor, or what is left of it is the rig's
            own scatter in stiffness and damping
explained   the best candidate is at the noise floor and nothing else comes near it, but for what
            asks the rig's constants to be off by chance
undecided   another candidate, not a richer relative of the best, fits alike
unknown     nothing that was tried brings the residual to the noise floor
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from diagnosis.selection.candidate import Candidate


class VerdictKind(StrEnum):
    """The four verdicts."""

    NONE = "none"
    EXPLAINED = "explained"
    UNKNOWN = "unknown"
    UNDECIDED = "undecided"


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What was concluded.

    Attributes:
      effects: accepted, strongest first.
      confusable: sets of effects that fit alike, the accepted one first.
      best: the candidate that predictions and parameters are of.
      rivals: candidates that explain the log as well as the best.
      ranking: explanations with probabilities that add up to 1, most probable first: every effect of
        the library alone, sets of several that were fitted, `NOTHING` and `UNEXPLAINED`.
      other_form: what refutes the best, in plain words, a free-form law say; empty: nothing does.
      as_near: sets that come about as near to an unknown log as the best, nearest first.
    """

    kind: VerdictKind
    effects: tuple[str, ...]
    confusable: tuple[tuple[str, ...], ...]
    best: Candidate
    rivals: tuple[Candidate, ...] = ()
    ranking: tuple[tuple[tuple[str, ...], float], ...]
    other_form: str = ""
    as_near: tuple[tuple[str, ...], ...] = ()

    @property
    def settled(self) -> bool:
        """Whether the log is explained, be it by nothing."""
        return self.kind in (VerdictKind.NONE, VerdictKind.EXPLAINED)


def distinct(sets: Iterable[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Sets of effects, each once, as it is first named."""
    found: dict[frozenset[str], tuple[str, ...]] = {}
    for names in sets:
        found.setdefault(frozenset(names), names)
    return tuple(found.values())
