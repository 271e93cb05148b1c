"""The first fit of a family, for a rougher needle: from where screening leads, without fine coordinates.

Each coordinate costs a simulation. The fine ones of a smooth curve hardly change it unless it is rough:
the promise of a family shows without them, and later fits have them all. Slopes along the nuisance,
which moves by a few per cent, are those of the rig without the law.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.freeform import FEW_PROMISE
from diagnosis.effects.effect import Effect
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.objective import NearStart
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.family import Family
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.screening import screen

Array = NDArray[np.float64]

FIRST_ITERATIONS, FEW_ITERATIONS = 1, 3
FEW_NUMBERS = 5  # of a law that takes more iterations at once: it costs little, and is no curve


def first_fit(rough: FitProblem, base: Fit, family: Family) -> FreeFit:
    """The family fitted for one iteration, a few where it has few numbers which promise something.

    Args:
      base: fit of the rig without it.

    Raises:
      SimulationFailed: the rig with the law cannot be simulated.
    """
    problem = with_family(rough, without_fine(family))
    neutral, few = _starts_neutral(family), len(family.effect.parameters) <= FEW_NUMBERS
    if neutral:
        start = problem.parameterization((family.name,)).joined(base.parts)
    else:
        screened = screen(problem, base, family.name)
        start = screened[0].start
        few &= any(one.gain > FEW_PROMISE * (base.cost - base.samples) for one in screened)
    near = NearStart(slopes=np.vstack(base.jacobian), by_trial=base.by_trial if neutral else None)
    iterations = FEW_ITERATIONS if few else FIRST_ITERATIONS
    fit = fit_effects(problem, (family.name,), start, most_iterations=iterations, near=near)
    fit = with_fine(fit, with_family(rough, family), family).with_its_prediction()
    return FreeFit(family=family, fit=fit, gap_after=fit.gap)


def _starts_neutral(family: Family) -> bool:
    """Whether it starts from no law at all: a curve does."""
    return all(not p.logarithmic and set(p.start) == {0.0} for p in family.effect.parameters)


def without_fine(family: Family) -> Family:
    """The family with its fine coordinates at 0."""
    kept = _kept(family)
    if kept.all():
        return family
    effect = family.effect
    coarse = replace(
        effect,
        parameters=tuple(p for p, keep in zip(effect.parameters, kept, strict=True) if keep),
        apply=partial(_apply, effect, tuple(bool(keep) for keep in kept)),
    )
    return replace(family, effect=coarse)


def _kept(family: Family) -> NDArray[np.bool_]:
    return np.array([not p.fine for p in family.effect.parameters], bool)


def _apply(effect: Effect, kept: tuple[bool, ...], rig: RigParameters, *values: float) -> RigParameters:
    given = iter(values)
    return effect.apply(rig, *(next(given) if keep else 0.0 for keep in kept))


def with_fine(fit: Fit, problem: FitProblem, family: Family) -> Fit:
    """The fit with fine coordinates at 0, of which nothing is known."""
    whole = problem.parameterization(fit.names)
    kept = np.ones(len(whole.owners), bool)
    kept[np.flatnonzero([owner == family.name for owner in whole.owners])] = _kept(family)
    if kept.size == fit.x.size:
        return fit
    x = np.zeros(kept.size)
    x[kept] = fit.x
    slopes = [np.zeros((len(own), kept.size)) for own in fit.jacobian]
    for wide, own in zip(slopes, fit.jacobian, strict=True):
        wide[:, kept] = own
    return replace(fit, parameterization=whole, x=x, jacobian=tuple(slopes))
