"""Plain laws in place of the free-form curves that resemble them, fitted through the simulation.

A plain law has few parameters, so it also tells what happens where no other trial has been. The curves
of the likeliest fits are looked at, of two laws at most: what is made of three is no plain law. Where
one resembles plain laws, these are fitted to the decimated log, and the best of them to the log in its
place. It is dropped if it leaves more than its fewer parameters are worth.

A trial is predicted by the plain law if the other trials determine that; if they do not, by the curve,
whose prior knows how little they tell.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.freeform import FAR_GAP, PLAIN_LAW_DETERMINED
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.family import Family, kind_of
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.freeform.fits.held_out_check import fitted_and_checked, left_open
from diagnosis.freeform.law_curve import law_of
from diagnosis.freeform.likeness.likeness import plain_laws_of, recognised
from diagnosis.freeform.likeness.plain_family import plain_family
from diagnosis.freeform.likeness.shapes import LEVEL
from diagnosis.freeform.missing.places import likelier_first
from diagnosis.workers import Task, Workers

Array = NDArray[np.float64]

STAGE = "plain laws"
MOST_LAWS = 2
MOST, SHAPES = 2, 4  # fits that are looked at, and plain laws that are tried of each, likeliest first
ITERATIONS = 10  # on the decimated log


def with_plain_laws(
    problem: FitProblem, coarse: FitProblem, fits: Sequence[FreeFit], workers: Workers
) -> tuple[FreeFit, ...]:
    """The fits, with plain laws in place of the curves that leave no less on unseen trials.

    Args:
      problem, coarse: the log itself, and decimated.
    """
    near = [f for f in likelier_first(fits) if f.final and f.fit.gap <= FAR_GAP][:MOST]
    near = [f for f in near if len(f.families) <= MOST_LAWS]
    nearest = _nearest_plain_laws(coarse, near, workers)
    tasks = [Task(effects=f.fit.names, arguments=(problem, curve, f)) for curve, f in nearest]
    checked = zip(nearest, workers.each(STAGE, _checked, tasks), strict=True)
    plain = [(curve, f) for (curve, _), f in checked if isinstance(f, FreeFit)]
    replaced = [id(curve) for curve, f in plain if f.gap_after <= curve.gap_after]
    return (*(f for _, f in plain), *(f for f in fits if id(f) not in replaced))


def _nearest_plain_laws(
    coarse: FitProblem, curves: Sequence[FreeFit], workers: Workers
) -> list[tuple[FreeFit, FreeFit]]:
    """Each curve that resembles plain laws, and the one of these that leaves least."""
    pairs = [(curve, family) for curve in curves for family in _plain_families(curve)]
    tasks = [Task(effects=own.fit.names, arguments=(coarse, own, family)) for own, family in pairs]
    found = workers.each(STAGE, fitted_near, tasks)
    each = [(curve, f) for (curve, _), f in zip(pairs, found, strict=True) if isinstance(f, FreeFit)]
    nearest = [
        (curve, min((f for own, f in each if own is curve), key=lambda f: f.score, default=None))
        for curve in curves
    ]
    # What is level does not depend on the variable.
    return [(curve, f) for curve, f in nearest if f is not None and f.family.shape != LEVEL]


def _plain_families(curve: FreeFit) -> list[Family]:
    """Plain laws that the curve resembles, likeliest first."""
    law = law_of(curve)
    parameterization = curve.fit.parameterization
    own = np.array([owner == curve.family.name for owner in parameterization.owners])
    values = np.array(parameterization.values(curve.fit.x))[own]
    more = any(not kind_of(p) for p in curve.family.effect.parameters)  # numbers beside those of a curve
    shapes = plain_laws_of(law, SHAPES) if more else recognised(law)[:SHAPES]
    families = (plain_family(curve.family, values, law, shape) for shape in shapes)
    return [family for family in families if family]


def _checked(problem: FitProblem, curve: FreeFit, nearest: FreeFit) -> FreeFit | None:
    """The plain law fitted to the log and checked there; None: it leaves more than the curve."""
    best = fitted_and_checked(problem, nearest, nearest.fit.x)
    if best.score >= curve.score:
        return None
    return replace(best, held_out=_each_by_what_is_determined(best, curve))


def fitted_near(coarse: FitProblem, curve: FreeFit, family: Family) -> FreeFit:
    """A plain law in place of the curve, fitted to the decimated log."""
    plain = replace(curve, family=family, final=False)
    own = with_family(coarse, *plain.families)
    begun = np.array([p.to_fit(p.start[0]) for p in family.effect.parameters])
    start = own.parameterization(plain.names).joined({**curve.fit.parts, family.name: begun})
    return replace(plain, fit=fit_effects(own, plain.names, start, most_iterations=ITERATIONS))


def _each_by_what_is_determined(plain: FreeFit, curve: FreeFit) -> tuple[Array, ...] | None:
    """Residuals / sigma of held-out trials by the plain law, or by the curve."""
    if plain.held_out is None or curve.held_out is None:
        return plain.held_out
    each = zip(plain.held_out, curve.held_out, strict=True)
    determined = [
        float(left_open(plain.fit, i).mean()) <= PLAIN_LAW_DETERMINED for i in range(len(plain.held_out))
    ]
    return tuple(p if own else c for own, (p, c) in zip(determined, each, strict=True))
