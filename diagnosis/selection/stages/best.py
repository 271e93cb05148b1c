"""The best explanation taken apart: its fit to the end, without each of its effects, its scatter."""

from collections.abc import Sequence
from itertools import combinations
from typing import Any

import numpy as np

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.freeform import FAR_GAP, PLAINER_LEAVES, PLAINER_SETS
from diagnosis.criteria.selection import CONTENDING, FINALISTS, SIMPLE_LEAD
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.bounded_least_squares import predicted_reduction
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.fit_status import Termination
from diagnosis.selection.fitting import fit_all, fit_beside
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

BOTH_ALIKE = "torque_scale"
"""The effect that no log tells from stiffness and damping that are off by the same."""


def best_to_its_end(state: SearchState, workers: Workers) -> SearchState:
    """The fit of the best, where it was given up for staying far above the noise."""
    best = state.best
    if best.fit.status.termination is not Termination.BEHIND:
        return state
    return state.adding(fit_all("best to its end", [(state.problem, best.names, best.fit.x)], workers))


def plainer_sets(state: SearchState, workers: Workers) -> SearchState:
    """Sets of fewer parameters that leave hardly more, where all of them are far above the noise."""
    best = state.best
    if best.fit.gap <= FAR_GAP:
        return state
    known = {frozenset(c.names) for c in state.candidates}
    plainer = {
        frozenset(c.names): c
        for c in sorted(state.about_as_near(best.names, PLAINER_LEAVES), key=lambda c: -c.fit.gap)
        if c.fit.size < best.fit.size and frozenset(c.names) not in known
    }
    other = {key: len(key - {*best.names}) for key in plainer}
    least = sorted(plainer, key=lambda key: (plainer[key].fit.size, other[key], plainer[key].fit.gap))
    calls = [(state.problem, plainer[key].names, plainer[key].fit.x) for key in least[:PLAINER_SETS]]
    return state.adding(fit_all("plainer sets", calls, workers))


def best_without_each_effect(state: SearchState, workers: Workers) -> SearchState:
    """The best without each of its effects, which may only compensate for errors of the others.

    Fewer leave no less, so that above the noise there is nothing to ask. A set that was fitted begins
    once more from the best where it left clearly more than the slopes of the best promise: it had ended
    elsewhere, and the effect would be named for that.
    """
    best = state.best
    if len(best.names) < 2:
        return state
    state, _ = state.rechecked()
    if not state.at_the_floor(best):
        return state
    known = {frozenset(c.names): c for c in sorted(state.candidates, key=lambda c: -c.score)}
    fewer = [
        names
        for names in combinations(best.names, len(best.names) - 1)
        if (was := known.get(frozenset(names))) is None
        or was.fit.cost > _cost_without(best.fit, *({*best.names} - {*names})) + SIMPLE_LEAD
    ]
    return state.adding(fit_beside("best without each effect", state.problem, best, fewer, workers))


def _cost_without(fit: Fit, name: str) -> float:
    """Cost that the slopes of a fit promise without one effect; infinite if they cannot tell."""
    parameterization = fit.parameterization
    absent = [_absent_at(p) for p in parameterization.parameters]
    own = np.array([owner == name for owner in parameterization.owners])
    at = np.where(own, absent, fit.x)
    if not np.isfinite(at).all():
        return np.inf
    low, high = parameterization.bounds()
    moves = [np.where(own, at, end) - fit.x for end in (low, high)]
    return fit.cost - predicted_reduction(fit.slopes, fit.residual, *moves)


def _absent_at(parameter: Parameter) -> float:
    """Coordinate of a fit at which an effect is absent; not finite if there is none."""
    if parameter.neutral is None or (parameter.logarithmic and parameter.neutral <= 0.0):
        return np.nan
    return parameter.to_fit(parameter.neutral)


def scatter_of_the_best(state: SearchState, workers: Workers) -> SearchState:
    """What leading sets name of stiffness and damping, without the prior of scatter that pulls it.

    That is the best, and those at the noise floor that this prior alone keeps behind it. Where the best
    would stay above the noise without the prior, there is nothing to ask. Where both are named, the gain
    of the torque sensor, which is both off alike, stands in their place as well.
    """
    best = state.best
    if _gap_without_prior(best.fit, best.scatter_named) > best.floor.gap_limit:
        return state
    reach = best.score - best.fit.prior + CONTENDING
    near = [c for c in state.candidates if c.floor.reached and c.score - c.fit.prior <= reach]
    near = [c for c in (best, *near) if c.scatter_named]
    known = {frozenset(c.names) for c in state.candidates}
    calls: dict[frozenset[str], tuple[Any, ...]] = {}
    for one in sorted(near, key=lambda c: c.score)[:FINALISTS]:
        both = len(one.scatter_named) == len(SCATTER)
        for more in (one.scatter_named, (BOTH_ALIKE,)) if both else (one.scatter_named,):
            names = tuple(dict.fromkeys((*one.names, *more)))
            if frozenset(names) not in known:
                start = state.problem.parameterization(names).joined(one.fit.parts)
                calls.setdefault(frozenset(names), (state.problem, names, start))
    return state.adding(fit_all("scatter of the best", [*calls.values()], workers))


def _gap_without_prior(fit: Fit, names: Sequence[str]) -> float:
    """The gap that a fit would leave without the prior on these effects, by its linear model."""
    own = np.isin(fit.parameterization.owners, names)
    weights = np.where(own, 0.0, fit.parameterization.weights)
    slopes = np.vstack([*fit.jacobian, np.diag(weights)])
    residual = np.concatenate([*fit.by_trial, weights * fit.x])
    low, high = fit.parameterization.bounds()
    reduction = predicted_reduction(slopes, residual, low - fit.x, high - fit.x)
    return float(np.sqrt(max(residual @ residual - reduction, 0.0) / fit.samples))
