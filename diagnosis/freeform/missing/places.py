"""In which place what the library lacks acts: probabilities, by what free-form laws leave.

Families are weighted by the gap g that they leave on trials that their fits have not seen,

    weight = [(FLOOR + g^2 - 1) (FLOOR + r^2 - 1)]^(-1 / PATIENCE) exp(-freedom / FREEDOM),

where r is the gap on the trials of the fit (over the least of these, if that is below the noise):
where few trials tell of a law, leaving one out says little. Far above the noise a law that leaves 10 %
more than another has a seventh of its weight by either, and near the noise, where laws are nearly
true, 2 % decide as much. A likelihood would decide more sharply; but no family is the true law, and
the best of them may be so by chance. Places that no family favours keep a small probability. The
library's nearest explanation, which has no place for what is missing, counts for all places alike:
where it leaves less than every family, none of them is likely. Of a single trial both gaps are one,
and count as one.
"""

import math
from collections.abc import Sequence

from diagnosis.criteria.freeform import CHOICE, COMPANION, FLOOR, FREEDOM, LEAST_WEIGHT, PATIENCE, SECOND
from diagnosis.effects.effect import Place
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.prior import well_determined


def likelier_first(fits: Sequence[FreeFit]) -> list[FreeFit]:
    """Fits to the log itself before others, and of these the likelier ones first.

    A law that may as well be elsewhere is as likely as the largest share of its places.
    """
    least = least_gap(fits)

    def weight(f: FreeFit) -> float:
        return _log_weight(f, least) + math.log(max(f.family.places.values()))

    return sorted(fits, key=lambda f: (not f.final, -weight(f)))


def least_gap(fits: Sequence[FreeFit]) -> float:
    """Of the fits to the log itself, on their own trials."""
    return min((f.fit.gap for f in fits if f.final), default=1.0)


def probabilities_of_places(
    fits: Sequence[FreeFit], nearest_gap: float, share: float = 1.0
) -> dict[Place, float]:
    """Probabilities of places, each by the best family that may be there.

    Args:
      share: by which logarithms of weights count.
    """
    least = least_gap(fits)
    logs = [share * _log_weight(f, least) for f in fits]
    own = nearest_gap / min(least, 1.0) if least > 0.0 else 1.0
    of_library = share * (_log_gap_weight(nearest_gap) + _log_gap_weight(own))
    best = max(*logs, of_library)
    everywhere = LEAST_WEIGHT + math.exp(of_library - best)
    most = dict.fromkeys(Place, 0.0)
    for one, log in zip(fits, logs, strict=True):
        for family in one.families:
            whole = 1.0 if family is one.family else SECOND
            for place, own_share in family.places.items():
                most[place] = max(most[place], whole * own_share * math.exp(log - best))
    weights = {place: everywhere + weight for place, weight in most.items()}
    return {place: weight / sum(weights.values()) for place, weight in weights.items()}


def _log_weight(one: FreeFit, least: float) -> float:
    freedom = sum(well_determined(family, one.fit) for family in one.families)
    freedom += COMPANION * (len(one.beside) + len(one.others))
    freedom += CHOICE * bool(one.family.shape)
    above = one.fit.gap / min(least, 1.0) if least > 0.0 else 1.0
    return _log_gap_weight(one.gap_after) + _log_gap_weight(above) - freedom / FREEDOM


def _log_gap_weight(gap: float) -> float:
    return -math.log(FLOOR + max(gap**2 - 1.0, 0.0)) / PATIENCE
