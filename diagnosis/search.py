"""Which effect, or which pair of them, explains a log.

1. Every effect of the vocabulary is glanced at, and the most promising are fitted,
   on the thinned log; the best of these are then fitted on the log itself.
2. If none of them brings the residual to the noise floor, every pair of a leading
   effect with any other is glanced at, and so on as before. If one does, but a second
   effect promises to take more off than noise could, that pair is fitted as well.
3. Fits are ranked by cost plus log(samples) a parameter (BIC): richer effects pay
   for their freedom. What the nuisance of the rig's own scatter explains is `none`.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from diagnosis.candidate import Candidate, candidate
from diagnosis.coordinates import coordinates_of
from diagnosis.effects import LIBRARY
from diagnosis.evidence import Evidence
from diagnosis.finer import finely_fitted
from diagnosis.fit import Fit, fit_effects
from diagnosis.glance import Hint, glance
from diagnosis.nuisance import SCATTER
from diagnosis.refine import refined
from diagnosis.team import Team

_PAIRS, _BASES = 20, 6  # pairs that are fitted on the thinned log; singles that they build on
_BATCH = 4  # fits between looks at what has been reached
_NEAR = 3.0  # times the cost at the floor: what promises more is not fitted
_WORTH = 6.0  # of cost: an effect that promises less is not fitted
SECOND_LEAVES = 0.99  # of the cost, at most: half a per cent of the gap; chance takes off up to 0.3 %
_FINALISTS = 4  # that are fitted on the log itself
_CONTENDING = 60.0  # and lie no further than this from the best, in cost


def search(
    evidence: Evidence, coarse: Evidence, effects: Sequence[str], team: Team
) -> tuple[Evidence, list[Candidate]]:
    """Candidates that were fitted on the log itself, best first, and evidence as fine as they ask.

    Args:
      coarse: the thinned evidence.
      effects: that may be tried.
    """
    found = _plain(evidence, team)
    found += [c for torn in found if torn.torn for c in _each_alone(evidence, torn, SCATTER, team)]
    start = fit_effects(coarse, ())
    hints = _glances(team, "effects", [(coarse, start, e) for e in effects])
    # Where something is missing, scatter has taken over a part of it, and a glance may be blind.
    missing = not candidate(start).floor.small
    worth = [h for h in hints if missing or h.gain >= _WORTH]
    singles = _fit_best(coarse, worth, len(worth), team, "effects")
    found += _finals(evidence, singles, team)
    evidence, found = finely_fitted(evidence, found, team)
    alone = _explained(evidence, found)
    second = _seconds(coarse, singles, effects, team, alone=alone)
    pairs = _finals(evidence, _fit_best(coarse, second, _PAIRS, team, "pairs"), team)
    found += _more_than_asked(pairs, found, singles[0]) if alone and singles else pairs
    best = min(found, key=lambda c: c.score)
    if len(best.names) > 1:
        found += _each_alone(evidence, best, best.names, team)
    best = min(found, key=lambda c: c.score)
    if best.named != best.names:
        # What is no scatter is fitted without the prior of scatter, which would pull it.
        there = coordinates_of(best.named, evidence.nuisance).joined(best.fit.parts)
        found.append(candidate(fit_effects(evidence, best.named, there)))
    return finely_fitted(evidence, found, team)


def _seconds(
    coarse: Evidence, singles: Sequence[Candidate], effects: Sequence[str], team: Team, *, alone: bool
) -> list[Hint]:
    """Pairs that are worth a fit; where an effect alone explains the log, hardly ever any."""
    bases = product(singles[: 1 if alone else _BASES], effects)
    hints = _glances(team, "pairs", [(coarse, c.fit, e) for c, e in bases if e not in c.names])
    if not alone:
        return [h for h in hints if h.gain >= _WORTH]
    return [h for h in hints if h.cost < SECOND_LEAVES * singles[0].fit.cost]


def _more_than_asked(
    pairs: Sequence[Candidate], found: Sequence[Candidate], single: Candidate
) -> list[Candidate]:
    """Pairs that take off the log itself what a second effect has to promise on the thinned one."""
    most = min(c.fit.cost for c in found) - (1 - SECOND_LEAVES) * single.fit.cost
    return [c for c in pairs if c.fit.cost <= most]


def _each_alone(
    evidence: Evidence, whole: Candidate, names: Iterable[str], team: Team
) -> list[Candidate]:
    """Each of what a candidate names alone, from where that is: others may have been a crutch."""
    starts = [(n, coordinates_of((n,), evidence.nuisance).joined(whole.fit.parts)) for n in names]
    calls = [(evidence, (n,), start) for n, start in starts]
    return [candidate(fit) for fit in team.each("fitting each alone", fit_effects, calls)]


def _explained(evidence: Evidence, found: Sequence[Candidate]) -> bool:
    """Whether one of the candidates is at the noise floor, as the best of them leaves it."""
    _, refloored = refined(evidence, sorted(found, key=lambda c: c.score))
    return any(c.explains for c in refloored)


def _plain(evidence: Evidence, team: Team) -> list[Candidate]:
    """The nominal rig, and the nominal rig with its scatter if that is needed."""
    calls = [(replace(evidence, nuisance=()), ()), (evidence, ())]
    exact, *scattered = map(candidate, team.each("replaying", fit_effects, calls))
    enough = exact.floor.reached and all(exact.score <= s.score + 10 for s in scattered)
    return [exact] if enough else [exact, *scattered]


def _glances(team: Team, what: str, calls: Sequence[tuple[Evidence, Fit, str]]) -> list[Hint]:
    return [hint for found in team.each(f"glancing at {what}", glance, calls) for hint in found]


def _fit_best(
    evidence: Evidence, hints: Sequence[Hint], most: int, team: Team, what: str
) -> list[Candidate]:
    """Fits of the most promising hints, best first.

    Once something brings the residual to the noise floor, only what promises to come
    near it is still fitted, and what that contains.
    """
    waiting, found = sorted(hints, key=lambda h: h.cost)[:most], list[Candidate]()
    while waiting:
        batch, waiting = waiting[:_BATCH], waiting[_BATCH:]
        fits = team.each(f"fitting {what}", fit_effects, [(evidence, h.names, h.start) for h in batch])
        found += map(candidate, fits)
        floor = min((c.fit.cost for c in found if c.floor.small), default=np.inf)
        inner = {i for c in found if c.floor.small for n in c.names for i in LIBRARY[n].contains}
        waiting = [h for h in waiting if h.cost <= _NEAR * floor or not inner.isdisjoint(h.names)]
    best: dict[frozenset[str], Candidate] = {}
    for c in sorted(found, key=lambda c: c.score):
        best.setdefault(frozenset(c.names), c)
    return list(best.values())


def _finals(evidence: Evidence, contenders: Sequence[Candidate], team: Team) -> list[Candidate]:
    """The best contenders, fitted on the log itself."""
    near = [c for c in contenders if c.score - contenders[0].score <= _CONTENDING]
    calls = [(evidence, c.names, c.fit.x) for c in near[:_FINALISTS]]
    return [candidate(fit) for fit in team.each("fitting the best", fit_effects, calls)]
