"""Which free-form law closes most of a gap that no effect of the library explains.

Every family is fitted through the simulation: for one iteration on the decimated log, a few where it
has few numbers; the most promising for a few more; the best to their end there, the strength of their
prior estimated, alone and, if none closes the gap, beside the effects of the library that promise most
there; the best of these on the log itself, and checked on trials that the fit has not seen. Those that
promise far more than the least gap do not go on. Where all leave far more than noise, fewer go to the
log itself, and not to their end.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import CLOSED_GAP, FAR_GAP
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.held_out.refits import held_out_or_refitted
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.families import families_of
from diagnosis.freeform.family import Family
from diagnosis.freeform.prior import free_covariance, well_determined, with_estimated_prior
from diagnosis.freeform.ranges import ranges_of
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.screening import Screened, screen
from diagnosis.workers import Failure, Task, Workers
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]

SCREENING, FITTING, SCREENING_BESIDE, BESIDE, FINALS = (
    "screening free-form laws",
    "free-form laws",
    "screening effects beside a free-form law",
    "free-form laws beside an effect",
    "finalists, free-form laws",
)
FIRST_ITERATIONS, MORE_ITERATIONS, ITERATIONS = 1, 3, 10
FEW_NUMBERS = 5  # of a law that takes more iterations at once: it costs little, and is no curve
WORTH_MORE = 10  # families that get more than the first iteration
IN_REACH = 2.5  # times the least gap that one promises
CONTENDERS, ACCOMPANIED, COMPANIONS, FINALISTS = 6, 6, 2, 4
STARTS_BESIDE = 2  # of an effect that is screened beside a law
FINAL_ITERATIONS = 5  # from the end on the decimated log: what is right gets there in three
FINAL_SIGMA = 0.1  # tolerance: a curve has a band of two of these
FAR_ITERATIONS, FAR_FINALISTS = 3, 2
WORTH_A_FINAL, WORTH_A_FINAL_BESIDE = 2.0, 1.3  # times the least gap; where that closes the gap


_SOFTER = RigParameters(damping_scale=0.95)


@dataclass(frozen=True, kw_only=True, eq=False)
class FreeFit:
    """A family fitted to a log.

    Attributes:
      beside: effects of the library that are in the fit as well.
      held_out: residuals / sigma by trial that the fit has not seen; None where there are none.
      gap_after: on these (`predictive_gap`); on the trials of the fit where there are none.
      final: whether it was fitted to the log itself, not the decimated one.
    """

    family: Family
    fit: Fit
    beside: tuple[str, ...] = ()
    held_out: tuple[Array, ...] | None = None
    gap_after: float = np.inf
    final: bool = False

    @property
    def score(self) -> float:
        """Least is best: the cost in units of itself, and a penalty for what the data determine."""
        return self._score(self.fit.cost)

    @property
    def promise(self) -> float:
        """The score that one more step of the fit promises."""
        return self._score(self.fit.promised_cost)

    @property
    def promised_gap(self) -> float:
        """The gap that one more step of the fit promises, with the prior."""
        return float(np.sqrt(max(self.fit.promised_cost, 0.0) / self.fit.samples))

    def _score(self, cost: float) -> float:
        samples = self.fit.samples
        freedom = well_determined(self.family, self.fit) + 2.0 * len(self.beside)
        return samples * float(np.log(cost / samples)) + freedom * float(np.log(samples))


def free_form_fits(
    problem: FitProblem,
    coarse: FitProblem,
    effects: Sequence[str],
    workers: Workers,
) -> tuple[FreeFit, ...]:
    """The best fit of every family; those of the log itself before the others.

    Args:
      problem, coarse: the log itself, and decimated.
      effects: of the library, which may stand beside a law.
    """
    nominal = replay(coarse.log, resolution=coarse.resolution)
    softer = replay(coarse.log, _SOFTER, coarse.resolution)
    families = families_of(ranges_of(coarse, nominal, softer))
    base = fit_effects(coarse, ())
    first = _each(SCREENING, _first_fit, [(coarse, base, f) for f in families], workers)
    better, rest = _promising(first, WORTH_MORE)
    first = _each(SCREENING, _some_more, [(coarse, f) for f in better], workers) + rest
    near, _ = _promising(first, CONTENDERS)
    fitted = _each(FITTING, _to_its_end, [(coarse, f, ()) for f in near], workers)
    if fitted and min(f.fit.gap for f in fitted) > CLOSED_GAP:
        enough = WORTH_A_FINAL**2 * min(f.fit.cost for f in fitted)
        pairs = _most_promising_pairs(coarse, fitted, effects, workers)
        calls = [(coarse, f, s.names[-1:], enough, s.start) for f, s in pairs]
        fitted += _each(BESIDE, _to_its_end, calls, workers)
    least = min((f.fit.gap for f in fitted), default=np.inf)
    far = _gap_on_the_log(least, problem, coarse) > FAR_GAP
    reach = WORTH_A_FINAL_BESIDE if least <= CLOSED_GAP else WORTH_A_FINAL
    worth = [f for f in fitted if f.fit.gap <= reach * least]
    last = _distinct(sorted(worth, key=lambda f: f.score))[: FAR_FINALISTS if far else FINALISTS]
    finals = _each(FINALS, _on_the_log, [(problem, f, far) for f in last], workers)
    names = {f.family.name for f in finals}
    fitted_names = {f.family.name for f in fitted}
    others = [f for f in (*fitted, *(f for f in first if f.family.name not in fitted_names))]
    behind = _distinct(sorted((f for f in others if f.family.name not in names), key=lambda f: f.score))
    return (*finals, *behind)


def _gap_on_the_log(gap: float, problem: FitProblem, coarse: FitProblem) -> float:
    """Gap that is about that on the decimated log, whose samples are means of several readings."""
    readings = problem.samples / max(coarse.samples, 1)
    return float(np.sqrt(1.0 + max(gap**2 - 1.0, 0.0) / readings))


def with_family(problem: FitProblem, family: Family) -> FitProblem:
    """The problem, its library with a family in it."""
    return replace(problem, library={**problem.library, family.name: family.effect})


def _each(
    stage: str, function: Callable[..., FreeFit], calls: Sequence[tuple[Any, ...]], workers: Workers
) -> list[FreeFit]:
    tasks = [Task(effects=(), arguments=call) for call in calls]
    return [f for f in workers.each(stage, function, tasks) if not isinstance(f, Failure)]


def _most_promising_pairs(
    coarse: FitProblem, laws: Sequence[FreeFit], effects: Sequence[str], workers: Workers
) -> list[tuple[FreeFit, Screened]]:
    """Laws with effects beside them that could leave least, of each law at most `COMPANIONS`."""
    pairs = [(law, name) for law in laws for name in effects]
    tasks = [Task(effects=(name,), arguments=(coarse, law, name)) for law, name in pairs]
    each = workers.each(SCREENING_BESIDE, _screened_beside, tasks)
    screened = zip((law for law, _ in pairs), each, strict=True)
    found = [(law, s) for law, s in screened if not isinstance(s, Failure)]
    chosen: dict[str, list[tuple[FreeFit, Screened]]] = {}
    for law, s in sorted(found, key=lambda pair: pair[1].cost):
        own = chosen.setdefault(law.family.name, [])
        if len(own) < COMPANIONS and sum(map(len, chosen.values())) < ACCOMPANIED:
            own.append((law, s))
    return [pair for own in chosen.values() for pair in own]


def _screened_beside(coarse: FitProblem, law: FreeFit, name: str) -> Screened:
    return screen(with_family(coarse, law.family), law.fit, name, STARTS_BESIDE)[0]


def _first_fit(coarse: FitProblem, base: Fit, family: Family) -> FreeFit:
    problem = with_family(coarse, family)
    start = screen(problem, base, family.name)[0].start
    problem = replace(problem, differences_halved=True)
    few = len(family.effect.parameters) <= FEW_NUMBERS
    iterations = MORE_ITERATIONS if few else FIRST_ITERATIONS
    fit = fit_effects(problem, (family.name,), start, most_iterations=iterations)
    return FreeFit(family=family, fit=fit, gap_after=fit.gap)


def _some_more(coarse: FitProblem, first: FreeFit) -> FreeFit:
    own = with_family(coarse, first.family)
    fit = fit_effects(own, first.fit.names, first.fit.x, most_iterations=MORE_ITERATIONS)
    return replace(first, fit=fit, gap_after=fit.gap)


def _to_its_end(
    coarse: FitProblem,
    first: FreeFit,
    beside: tuple[str, ...],
    enough: float = np.inf,
    start: Array | None = None,
) -> FreeFit:
    """Fitted twice, unless it is given up: the second time with the strength of the prior that the first
    one speaks for.

    Args:
      enough: cost below which it is of use.
      start: the vector to start from; None: where the first fit ended.
    """
    family, problem = first.family, with_family(coarse, first.family)
    start, names = first.fit.x if start is None else start, (family.name, *beside)
    fit = fit_effects(problem, names, start, enough, most_iterations=ITERATIONS)
    if fit.status.ended_early:
        return FreeFit(family=family, fit=fit, beside=beside, gap_after=fit.gap)
    family = with_estimated_prior(family, fit)
    own = with_family(coarse, family)
    fit = fit_effects(own, names, fit.x, enough, most_iterations=ITERATIONS // 2)
    return FreeFit(family=family, fit=fit, beside=beside, gap_after=fit.gap)


def _on_the_log(problem: FitProblem, contender: FreeFit, far: bool) -> FreeFit:
    """Fitted to the log itself and checked on trials that the fit has not seen."""
    return fitted_and_checked(problem, contender, contender.fit.x, far=far)


def fitted_and_checked(
    problem: FitProblem, contender: FreeFit, start: Array, *, far: bool = False
) -> FreeFit:
    """The family of a contender, fitted to the log itself and checked on trials that it has not seen.

    Args:
      far: whether it leaves far more than noise: it is not fitted to its end, and checked by runs half
        as fine.
    """
    own = with_family(problem, contender.family)
    own = replace(own, differences_halved=True, tolerance_sigma=FINAL_SIGMA)
    names = (contender.family.name, *contender.beside)
    iterations = FAR_ITERATIONS if far else FINAL_ITERATIONS
    fit = fit_effects(own, names, start, most_iterations=iterations)
    if len(problem.log.trials) == 1:
        return replace(contender, fit=fit, gap_after=fit.gap, final=True)
    try:
        held_out = held_out_or_refitted(own.of_differences if far else own, fit, predictive_gap)
    except SimulationFailed:
        return replace(contender, fit=fit, gap_after=np.inf, final=True)
    gap = max(predictive_gap(fit, held_out), fit.gap)
    return replace(contender, fit=fit, held_out=held_out, gap_after=gap, final=True)


def predictive_gap(fit: Fit, held_out: Sequence[Array]) -> float:
    """Root mean square of residuals of held-out trials over their predictive standard deviation.

    That is the noise and what the other trials leave open of the curve: where none of them has been,
    its law says nothing, and nothing is held against it. Of a law that they determine it is the gap.
    """
    squares = [left**2 / (1.0 + left_open(fit, i)) for i, left in enumerate(held_out)]
    return float(np.sqrt(np.mean(np.concatenate(squares))))


def left_open(fit: Fit, trial: int) -> Array:
    """Variance of a trial's prediction that the other trials leave open, in that of the noise, (N,)."""
    slopes = fit.jacobian[trial]
    return np.asarray(np.sum((slopes @ free_covariance(fit, without=trial)) * slopes, axis=1))


def _promising(fits: Sequence[FreeFit], most: int) -> tuple[list[FreeFit], list[FreeFit]]:
    """The most promising fits, those in reach of the best alone; and the rest.

    A law far from straight comes nowhere with its first step, and its slopes tell that it will.
    """
    ranked = sorted(fits, key=lambda f: f.promise)
    closed = any(f.fit.gap <= CLOSED_GAP for f in fits)
    reach = WORTH_A_FINAL_BESIDE if closed else IN_REACH
    reach *= min((f.promised_gap for f in fits), default=np.inf)
    best = [f for f in ranked[:most] if f.promised_gap <= reach]
    return best, [f for f in ranked if f not in best]


def _distinct(ranked: Sequence[FreeFit]) -> list[FreeFit]:
    """The best fit of each family."""
    best: dict[str, FreeFit] = {}
    for f in ranked:
        best.setdefault(f.family.name, f)
    return list(best.values())
