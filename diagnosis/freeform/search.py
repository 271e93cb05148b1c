"""Which free-form law closes most of a gap that no effect of the library explains.

Every family is fitted through the simulation: for one iteration on the decimated log with a rougher
needle, a few where it has few numbers; the promising for one more, since what is far from straight
shows little with its first; the most promising for a few more; the best to their end on the
decimated log, the strength of their prior estimated, with a finer curve where that promises more, and,
if none closes the gap, growing with another variable, then beside the effects of the library or the
other laws that promise most there, and if that is not enough but near, beside a third; the best of
these on the log itself, and checked on trials that the fit has not seen. Those whose predicted gap is
far above the least do not go on. Where all leave far more than noise, fewer go to the log itself, and
not to their end.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.freeform import CLOSED_GAP, FAR_GAP, FINAL_NUMBERS, THIRD_LAW_GAP
from diagnosis.fitting.decimation import gap_on_the_log
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.families import families_of
from diagnosis.freeform.family import Family
from diagnosis.freeform.fits.coarser_needle import on_coarser_needle
from diagnosis.freeform.fits.combined_laws import beside_one, beside_several, distinct, unlike
from diagnosis.freeform.fits.first_fit import first_fit
from diagnosis.freeform.fits.free_fit import FreeFit, each_fit, few_of_each, with_family
from diagnosis.freeform.fits.full_fit import full_fit
from diagnosis.freeform.fits.held_out_check import fitted_and_checked
from diagnosis.freeform.fits.noise_left import rescaled_fits
from diagnosis.freeform.fits.richer_laws import richer
from diagnosis.freeform.ranges import LogRanges, ranges_of
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.workers import Workers

Array = NDArray[np.float64]

SCREENING, FITTING, FINALS = (
    "screening free-form laws",
    "free-form laws",
    "finalists, free-form laws",
)
WORTH_A_SECOND, WORTH_MORE = 20, 10  # families that get a second iteration, and more than that
MORE_ITERATIONS = 2
IN_REACH, IN_REACH_AT_FIRST = 2.5, 5.0  # times the least predicted gap; after one iteration
CONTENDERS, FINALISTS, FAR_FINALISTS, FINALISTS_OF_ONE = 6, 4, 2, 2
FEWEST_FINALISTS = 2
WORTH_A_FINAL, WORTH_A_FINAL_BESIDE = 1.5, 1.3  # times the least gap; where that closes the gap

_SOFTER = RigParameters(damping_scale=0.95)


def free_form_fits(
    problem: FitProblem,
    coarse: FitProblem,
    effects: Sequence[str],
    workers: Workers,
    known: Sequence[FreeFit] = (),
) -> tuple[FreeFit, ...]:
    """The best fit of every family; those of the log itself before the others.

    Args:
      problem, coarse: the log itself, and decimated.
      effects: of the library, which may stand beside a law.
      known: fits of the decimated log, whose families are not begun anew.
    """
    nominal = replay(coarse.log, resolution=coarse.resolution)
    softer = replay(coarse.log, _SOFTER, coarse.resolution)
    ranges = ranges_of(coarse, nominal, softer)
    base = fit_effects(coarse, ())
    rough = on_coarser_needle(coarse, base)
    first, fitted = _alone(coarse, rough, base, families_of(ranges), known, workers)
    fitted = _richer(coarse, first, fitted, ranges, workers)
    if _open(fitted):
        fitted += beside_one(coarse, rough, base, fitted, first, effects, workers)
    if _open(fitted) and not _far(fitted, problem, coarse, THIRD_LAW_GAP):
        fitted += beside_several(coarse, rough, base, fitted, first, workers)
    far = _far(fitted, problem, coarse)
    finals = each_fit(FINALS, _on_the_log, [(problem, f, far) for f in _finalists(fitted, far)], workers)
    return (*finals, *_behind(finals, fitted, first))


def fits_in_noise(
    before: tuple[FitProblem, FitProblem],
    after: tuple[FitProblem, FitProblem],
    fits: Sequence[FreeFit],
    effects: Sequence[str],
    workers: Workers,
) -> tuple[FreeFit, ...]:
    """The fits in another noise, from where they are.

    Where none of these closes the gap there, the search is made again, with what each family is known to
    leave.

    Args:
      before, after: the log itself, and decimated, in either noise.
    """
    (_, coarse), (problem, quieter) = before, after
    finals = [f for f in fits if f.final]
    enough = (WORTH_A_FINAL * CLOSED_GAP) ** 2 * quieter.samples
    fitted = each_fit(FITTING, full_fit, [(quieter, f, enough, f.fit.x) for f in finals], workers)
    others = rescaled_fits([f for f in fits if not f.final], coarse, quieter.noise)
    if not fitted or _open(fitted):
        alone = [f for f in [*fitted, *others] if len(f.names) == 1]
        return free_form_fits(problem, quieter, effects, workers, distinct(alone))
    calls = [(problem, f, False) for f in _finalists(fitted, False)]
    finals = each_fit(FINALS, _on_the_log, calls, workers)
    return (*finals, *_behind(finals, [*fitted, *others], ()))


def _alone(
    coarse: FitProblem,
    rough: FitProblem,
    base: Fit,
    families: Sequence[Family],
    known: Sequence[FreeFit],
    workers: Workers,
) -> tuple[list[FreeFit], list[FreeFit]]:
    """The first fit of every family for a rougher needle, and those in reach, fitted to their end."""
    names = {f.family.name for f in known}
    new = [(rough, base, family) for family in families if family.name not in names]
    first = [*known, *each_fit(SCREENING, first_fit, new, workers)]
    rounds = ((WORTH_A_SECOND, IN_REACH_AT_FIRST, 1), (WORTH_MORE, IN_REACH, MORE_ITERATIONS))
    for worth, reach, iterations in rounds:
        better, rest = _promising(first, worth, reach)
        first = each_fit(SCREENING, _some_more, [(rough, f, iterations) for f in better], workers) + rest
    near, further = _promising(first, CONTENDERS)
    fitted = each_fit(FITTING, full_fit, [(coarse, f) for f in near], workers)
    if not fitted:  # the only ones in reach cannot be simulated where they lead
        near, _ = _promising(further, CONTENDERS)
        fitted = each_fit(FITTING, full_fit, [(coarse, f) for f in near], workers)
    return first, fitted


def _richer(
    coarse: FitProblem,
    first: Sequence[FreeFit],
    fitted: Sequence[FreeFit],
    ranges: LogRanges,
    workers: Workers,
) -> list[FreeFit]:
    """The fits, and those of richer families; of each law the best."""
    ranked = sorted(fitted, key=lambda f: f.score)
    growing = _open(fitted)
    alone = unlike(distinct([*ranked, *first])) if growing else _worth_a_final(ranked)
    more = richer(coarse, alone, ranges, workers, growing=growing)
    found = distinct(sorted([*fitted, *more], key=lambda f: f.score))
    finer = [f for f in found[:1] if f in more and f.family.name in {one.family.name for one in alone}]
    if finer:  # a narrow bump may need more
        found = [*richer(coarse, finer, ranges.in_more_detail, workers, growing=False), *found]
    return distinct(sorted(found, key=lambda f: f.score))


def _finalists(fitted: Sequence[FreeFit], far: bool) -> list[FreeFit]:
    """The fits that go to the log itself, best first."""
    ranked = _worth_a_final(sorted(fitted, key=lambda f: f.score))
    last = list(few_of_each(ranked, lambda f: f.family.name, FINALISTS_OF_ONE))
    return last[: FAR_FINALISTS if far else _affordable(last)]


def _worth_a_final(ranked: Sequence[FreeFit]) -> list[FreeFit]:
    """The fits that leave different things, and little more than the one that leaves least."""
    least = min((f.fit.gap for f in ranked), default=np.inf)
    reach = WORTH_A_FINAL_BESIDE if least <= CLOSED_GAP else WORTH_A_FINAL
    return unlike([f for f in ranked if f.fit.gap <= reach * least])


def _behind(
    finals: Sequence[FreeFit], fitted: Sequence[FreeFit], first: Sequence[FreeFit]
) -> list[FreeFit]:
    """The best fit of each family that did not get to the log itself."""
    names, fitted_names = ({f.family.name for f in fits} for fits in (finals, fitted))
    others = [*fitted, *(f for f in first if f.family.name not in fitted_names)]
    return distinct(sorted((f for f in others if f.family.name not in names), key=lambda f: f.score))


def _open(fits: Sequence[FreeFit]) -> bool:
    """Whether all leave more than little."""
    return bool(fits) and min(f.fit.gap for f in fits) > CLOSED_GAP


def _far(
    fits: Sequence[FreeFit], problem: FitProblem, coarse: FitProblem, most_gap: float = FAR_GAP
) -> bool:
    """Whether all leave far more than noise."""
    least = min((f.fit.gap for f in fits), default=np.inf)
    return gap_on_the_log(least, problem, coarse) > most_gap


def _some_more(rough: FitProblem, first: FreeFit, iterations: int) -> FreeFit:
    own = with_family(rough, first.family)
    fit = fit_effects(own, first.fit.names, first.fit.x, most_iterations=iterations)
    return replace(first, fit=fit.with_its_prediction(), gap_after=fit.gap)


def _on_the_log(problem: FitProblem, contender: FreeFit, far: bool) -> FreeFit:
    """Fitted to the log itself and checked on trials that the fit has not seen."""
    return fitted_and_checked(problem, contender, contender.fit.x, far=far).with_its_law_first


def _promising(
    fits: Sequence[FreeFit], most: int, in_reach: float = IN_REACH
) -> tuple[list[FreeFit], list[FreeFit]]:
    """The most promising fits, those in reach of the best alone; and the rest.

    A law far from straight comes nowhere with its first step, and its slopes tell that it will.
    """
    ranked = sorted(fits, key=lambda f: f.predicted_score)
    closed = any(f.fit.gap <= CLOSED_GAP for f in fits)
    reach = WORTH_A_FINAL_BESIDE if closed else in_reach
    reach *= min((f.predicted_gap for f in fits), default=np.inf)
    best = [f for f in ranked[:most] if f.predicted_gap <= reach]
    return best, [f for f in ranked if f not in best]


def _affordable(ranked: Sequence[FreeFit]) -> int:
    """How many go to the log itself: each number of a law is a simulation of it."""
    numbers = np.cumsum([f.fit.x.size for f in ranked[:FINALISTS]])
    return max(FEWEST_FINALISTS, int(np.sum(numbers <= FINAL_NUMBERS)))
