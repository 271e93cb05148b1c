"""The verdict of a search that was cut short: no more than what was tried can say.

An explanation at the noise floor may have rivals that nobody tried, and the nominal rig effects that
nobody looked for: neither `explained` nor `none` can be said.
"""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.selection.candidate import Candidate
from diagnosis.selection.verdict import Verdict, VerdictKind


def provisional(verdict: Verdict, candidates: Sequence[Candidate]) -> Verdict:
    """`undecided` between all that explain the log so far, that of the verdict first, or `unknown`.

    Args:
      candidates: that were checked, best first.
    """
    if verdict.kind is VerdictKind.UNKNOWN:
        return verdict
    others = [c for c in candidates if c.explains and c is not verdict.best]
    sets = {frozenset(names): names for names in (*(c.named for c in others[::-1]), verdict.effects)}
    confusable = tuple(reversed(sets.values()))
    return replace(verdict, kind=VerdictKind.UNDECIDED, confusable=confusable, rivals=tuple(others))
