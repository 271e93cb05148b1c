"""A verdict after what was learned besides: a search cut short, effects that may hide, a better law."""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.selection.candidate import Candidate
from diagnosis.selection.verdicts.ranking import NOTHING, ranking_of
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind, distinct


def provisional(verdict: Verdict, candidates: Sequence[Candidate]) -> Verdict:
    """The verdict of a search that was cut short: no more than what was tried can say.

    An explanation at the noise floor may have rivals that nobody tried, and the nominal rig effects
    that nobody looked for. So it is `undecided` between all that explain the log so far, that of the
    verdict first, or `unknown`.

    Args:
      candidates: that were checked, best first.
    """
    if verdict.kind is VerdictKind.UNKNOWN:
        return verdict
    others = [c for c in candidates if c.explains and c is not verdict.best]
    confusable = distinct((verdict.effects, *(c.named for c in others), *verdict.confusable))
    return replace(verdict, kind=VerdictKind.UNDECIDED, confusable=confusable, rivals=tuple(others))


def with_open_effects(verdict: Verdict, effects: Sequence[str]) -> Verdict:
    """The verdict where effects may be there, or not: what is allowed for does the same as they.

    Args:
      effects: none of the verdict's own.
    """
    if verdict.kind is VerdictKind.UNKNOWN or not effects:
        return verdict
    told = verdict.confusable or (verdict.effects,)
    beside = tuple((*names, *effects) for names in told)
    shares = dict(verdict.ranking)
    for names, both in zip(told, beside, strict=True):
        alone, wider = tuple(sorted(names)) or (NOTHING,), tuple(sorted(both))
        shares[alone] = 0.5 * shares.get(alone, 0.0)
        shares[wider] = shares.get(wider, 0.0) + shares[alone]
    ranking = tuple(sorted(shares.items(), key=lambda item: -item[1]))
    return replace(verdict, kind=VerdictKind.UNDECIDED, confusable=(*told, *beside), ranking=ranking)


def refuted(verdict: Verdict, form: str) -> Verdict:
    """The verdict where an explanation is none: a law that no library holds does better, say.

    Args:
      form: why, in plain words: that law, and how it does better.
    """
    return Verdict(
        kind=VerdictKind.UNKNOWN,
        effects=(),
        confusable=(),
        best=verdict.best,
        ranking=ranking_of((), None),
        other_form=form,
    )
