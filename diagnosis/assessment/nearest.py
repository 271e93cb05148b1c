"""The nearest explanation: the best that was tried, whatever the verdict.

No model explains a real rig down to the noise. If the verdict is `unknown`, this still tells the
nearest explanation, how much of the gap it explains, and which parameters stopped at a bound. The
power explained is a share of that of the nominal residual beyond noise,

    explained = (before^2 - after^2) / (before^2 - 1),    before and after in sigma.

The intervals are wider than for an explanation that reaches the noise floor, by residual / sigma.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.forward_step import Further, forward_selection
from diagnosis.assessment.gap_reduction import GapReduction
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart
from diagnosis.criteria.freeform import FAR_GAP
from diagnosis.effects import IMPERFECTIONS
from diagnosis.fitting.fit import nominal_fit
from diagnosis.fitting.held_out.refits import held_out_or_refitted
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.nominal_replay import nominal_residuals
from diagnosis.replay.prediction import Prediction
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]
HeldOut = tuple[Array, ...]

ONE_TRIAL = (
    "the log has one trial, so none can be held out: the gap after is that of the fitted trial "
    "itself, and nothing shows whether its parameters hold for other trials; add a second trial"
)
ONE_MORE = "adding another effect"
"""A part that a stop leaves out."""


@dataclass(frozen=True, kw_only=True)
class Nearest:
    """The best explanation that was tried.

    Attributes:
      effects: strongest first; empty: nothing improves on the nominal rig.
      parameters: intervals by effect and parameter.
      gap_after: rms of residual / sigma with it, on held-out trials.
      power_explained_percent: share of the power of the nominal residual beyond noise.
      at_bound: parameters that stopped at a bound, as effect.parameter.
      imperfections: what its fit allows for in the sensors.
      by_trial: its parameters with a value of their own in each trial, of an unknown log; by_motion: in
        each motion of the base.
    """

    effects: tuple[str, ...]
    parameters: Mapping[str, Mapping[str, Interval]]
    gap_after: float
    power_explained_percent: float
    at_bound: tuple[str, ...]
    imperfections: tuple[str, ...] = ()
    by_trial: tuple[ValuesByPart, ...] = ()
    by_motion: tuple[ValuesByPart, ...] = ()


def nearest_of(
    best: Candidate,
    effects: tuple[str, ...],
    parameters: Mapping[str, Mapping[str, Interval]],
    gap: GapReduction,
    by_trial: tuple[ValuesByPart, ...] = (),
    by_motion: tuple[ValuesByPart, ...] = (),
) -> Nearest:
    """The record of the best candidate; `effects`: strongest first.

    Args:
      parameters: intervals of all fitted parameters, by effect.
      by_trial, by_motion: parameters with a value of their own in each part of the log.
    """
    held = (*best.told_at_bound, *best.fit.constants_at_bound)
    return Nearest(
        effects=effects,
        parameters={name: parameters[name] for name in effects if name in parameters},
        gap_after=gap.after,
        power_explained_percent=_power_percent(gap),
        at_bound=tuple(p for p in held if p.partition(".")[0] in effects),
        imperfections=tuple(name for name in best.names if name in IMPERFECTIONS),
        by_trial=by_trial,
        by_motion=by_motion,
    )


def _power_percent(gap: GapReduction) -> float:
    """Power explained; 0 if the residual of the nominal rig does not exceed noise."""
    beyond = gap.before**2 - 1.0
    if beyond <= 0:
        return 0.0
    return 100.0 * min(max((gap.before**2 - max(gap.after, 1.0) ** 2) / beyond, 0.0), 1.0)


def nearest_candidate(
    problem: FitProblem,
    coarse: FitProblem,
    nominal: Sequence[Prediction],
    verdict: Verdict,
    further: Callable[[], Further | None],
    effects: Sequence[str],
    workers: Workers,
) -> tuple[Candidate, HeldOut, tuple[str, ...]]:
    """The best candidate, its residuals on held-out trials, and a warning if there are none.

    For an unknown log it is the best of the verdict with further effects that improve it; or the nominal
    rig, if that has no larger residual on held-out trials.

    Args:
      problem: the log itself; coarse: the decimated log.
      nominal: readings of the nominal rig by trial.
      further: asks for each further effect beside the best of the verdict; None: there is no time.
      effects: names of effects that may be tried.
    """
    if verdict.kind is not VerdictKind.UNKNOWN:
        return verdict.best, *_held_out(problem, verdict.best)
    near = _with_further_effects(problem, coarse, verdict.best, further(), effects, workers)
    after, lost = _held_out(problem, near)
    exact = nominal_fit(nominal_residuals(problem, nominal))
    if floor_of(after).gap < exact.gap:
        return near, after, lost
    return candidate(exact), exact.by_trial, lost


def _with_further_effects(
    problem: FitProblem,
    coarse: FitProblem,
    best: Candidate,
    further: Further | None,
    effects: Sequence[str],
    workers: Workers,
) -> Candidate:
    if further is None:
        return best
    if workers.stop.due:
        workers.stop.leave_out(ONE_MORE)
        return best
    fit = forward_selection(problem, coarse, best.fit, further, effects, workers)
    return best if fit is best.fit else candidate(fit)


def _held_out(problem: FitProblem, best: Candidate) -> tuple[HeldOut, tuple[str, ...]]:
    """Residuals of trials that the fit has not seen, and a warning if there are none."""
    if len(problem.log.trials) == 1:
        return best.fit.by_trial, (ONE_TRIAL,)
    if best.held_out is not None:
        return best.held_out, ()
    far = best.fit.gap > FAR_GAP  # then runs half as fine tell as much, at a quarter of the cost
    checked = replace(problem, differences_halved=True).of_differences if far else problem
    try:
        return held_out_or_refitted(checked, best.fit), ()
    except SimulationFailed as failed:
        warning = (
            "the gap after is that on the trials of the fit: a held-out trial cannot be simulated with "
            f"the parameters from the others ({failed})"
        )
        return best.fit.by_trial, (warning,)
