"""Which free-form law is worth a fit beside another, if no law alone closes the gap.

By a linear model of both at once. With J the slopes of the one law's fit, r what that leaves, K the
slopes of the other law's first fit, d what that changed of the readings, and W the weights of its prior,

    predicted cost = min over x, y, a of |r + J x + K y + a d|^2 + |W y|^2 + a^2,

which takes no simulation. Of the pairs of all laws with those that leave
least alone, the few that promise most are fitted.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.fits.linear_model import LinearModel, linear_model
from diagnosis.replay.free_law import FreeLaw
from models.errors import InvalidValue

Array = NDArray[np.float64]

PAIRS, PAIRS_OF_ONE = 6, 2  # that are fitted, in all and of one law
_ROUNDING = 1e-9  # of the squares of a column


@dataclass(frozen=True, kw_only=True, eq=False)
class _Other:
    """A law that may stand beside another: what its coordinates change of residuals, (N, k)."""

    fit: FreeFit
    columns: Array
    weights: Array


def laws_beside(base: Fit, laws: Sequence[FreeFit], others: Sequence[FreeFit]) -> list[FreeFit]:
    """Fits of laws, each with another law beside it that is not fitted yet; most promising first.

    Args:
      base: the fit without a law.
      laws: fits of laws, each alone or beside others, those that leave least first.
      others: first fits of all laws that may stand beside them.
    """
    known = [_other(base, one) for one in others]
    predicted, leading = [], set[str]()
    for law in laws:
        leading.add(law.family.name)  # of two laws the one that leaves less alone
        may_be = [o for o in known if o.fit.family.name not in {*leading, *law.names}]
        scores = _predicted_scores(law.fit, may_be)
        predicted += [(score, law, o.fit) for score, o in zip(scores, may_be, strict=True)]
    kept: list[FreeFit] = []
    for _, law, other in sorted(predicted, key=lambda one: one[0]):
        pair = replace(law, others=(*law.others, other.family))
        of_it = sum(k.fit is law.fit for k in kept)
        new = not any(_same(pair, k) for k in kept)
        if new and of_it < PAIRS_OF_ONE and len(kept) < PAIRS and _have_room(law, other):
            kept.append(pair)
    return kept


def _other(base: Fit, one: FreeFit) -> _Other:
    own = np.array([owner == one.family.name for owner in one.fit.parameterization.owners])
    change = np.concatenate(one.fit.by_trial) - np.concatenate(base.by_trial)
    return _Other(
        fit=one,
        columns=np.column_stack([np.vstack(one.fit.jacobian)[:, own], change]),
        weights=np.append(one.fit.parameterization.weights[own], 1.0),
    )


def _predicted_scores(law: Fit, others: Sequence[_Other]) -> list[float]:
    """Scores as of a FreeFit, which the law could come to beside each of the others."""
    model = linear_model(law)
    return [_score_of(model, law.samples, other.columns, other.weights) for other in others]


def predicted_score(law: Fit, columns: Array, weights: Array) -> float:
    """Score as of a FreeFit that a law could come to with more coordinates.

    Args:
      columns: what each of these changes of residuals, (N, k).
      weights: of their prior, (k,).
    """
    return _score_of(linear_model(law), law.samples, columns, weights)


def _score_of(model: LinearModel, samples: int, columns: Array, weights: Array) -> float:
    squares, along = model.beyond(columns)
    squares[np.diag_indices_from(squares)] += _ROUNDING * np.sum(columns**2, axis=0) + 1e-12
    whole = squares + np.diag(weights**2)
    solved = np.linalg.solve(whole, np.column_stack([along, squares]))
    cost = max(model.cost - float(along @ solved[:, 0]), 1e-12)
    freedom = float(np.trace(solved[:, 1:]))
    return samples * float(np.log(cost / samples)) + freedom * float(np.log(samples))


def _same(one: FreeFit, other: FreeFit) -> bool:
    return {f.name for f in one.families} == {f.name for f in other.families}


def _have_room(law: FreeFit, other: FreeFit) -> bool:
    """Whether a rig can have both."""
    one, more = (f.fit.parameterization.rig(f.fit.x).free or FreeLaw() for f in (law, other))
    try:
        one.beside(more)
    except InvalidValue:
        return False
    return True
