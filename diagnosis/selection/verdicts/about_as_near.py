"""What comes about as near to a log that nothing explains.

A set that leaves a few per cent more than the best, where both are far from the noise, may be nearer to
the truth: what all of them lack decides which leads. They are compared on the decimated log, where all
were fitted.
"""

from dataclasses import replace

from diagnosis.criteria.freeform import AS_NEAR_LEAVES, AS_NEAR_SETS
from diagnosis.effects import LIBRARY
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdicts.plainly_named import plain_names
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind, distinct


def with_what_is_as_near(verdict: Verdict, found: SearchState) -> Verdict:
    """A verdict that is unknown, with other sets that come about as near; any other as it is.

    A set that has all effects of the best, and more, is not another one. What the best needs in its
    sensors is left out once, too: others may need nothing of the kind.

    Args:
      found: what the search has come to.
    """
    if verdict.kind is not VerdictKind.UNKNOWN:
        return verdict
    names, own = verdict.best.names, {*_effects(verdict.best, found)}
    bare = tuple(name for name in names if name in LIBRARY)
    near = distinct(
        _effects(c, found)
        for each in dict.fromkeys((names, bare))
        for c in found.about_as_near(each, AS_NEAR_LEAVES)
    )
    others = [names for names in near if names and not own <= {*names}]
    return replace(verdict, as_near=tuple(others[:AS_NEAR_SETS]))


def _effects(one: Candidate, found: SearchState) -> tuple[str, ...]:
    """Effects of the library, but for stiffness and damping that every fit leaves open."""
    return plain_names([name for name in one.names if name in LIBRARY], found.problem)
