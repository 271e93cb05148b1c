"""What to do next, in words.

If one explanation is left: what to change in rig or model, and the run that would narrow the interval of
its leading parameter. If several are left: the run or the calibration that would tell them apart.
"""

from collections.abc import Sequence

from diagnosis.assessment.advice.experiments import experiments, has_axis, sliding_experiments
from diagnosis.assessment.advice.next_experiment import best_experiment, narrowest
from diagnosis.assessment.advice.remedies import Parameters, check_that_tells, remedies
from diagnosis.criteria.assessment import DECISIVE_SIGMA, KNOWN_WELL, MOST_RUNS, WORTH_A_RUN
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.residuals.residual_breakdown import ResidualBreakdown
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind
from diagnosis.stopping import stopping

_ONCE = 1.5  # runs, which are one
_WITHOUT_AXIS = "at two rates and two amplitudes, with reversals and with rests of two lengths"


def advise(
    problem: FitProblem,
    verdict: Verdict,
    nominal: ResidualBreakdown,
    left: ResidualBreakdown,
    parameters: Parameters,
) -> str:
    """One or two sentences; empty if nothing is left to do. After a stop, nothing is simulated for them.

    Args:
      problem: the decimated log, on which runs are simulated.
      nominal: breakdown of the residual of the nominal rig.
      left: breakdown of the residual of the best explanation.
      parameters: parameters of the accepted effects.
    """
    match verdict.kind:
        case VerdictKind.UNDECIDED:
            return "" if stopping() else _tell_apart(problem, verdict)
        case VerdictKind.UNKNOWN:
            return _look_closer(problem, nominal, left)
        case VerdictKind.EXPLAINED:
            return _change(problem, verdict, parameters)
    return ""


def _change(problem: FitProblem, verdict: Verdict, parameters: Parameters) -> str:
    """What to change if the log is explained, and the run that would make this more certain."""
    remedy = remedies(verdict.effects, parameters, problem.log.rig)
    if verdict.confusable:
        return f"{_check(verdict.confusable)}; if it is the former, {remedy}"
    again = "then record and diagnose again"
    narrowed = "" if _known_well(verdict, parameters) else _narrowed(problem, verdict)
    return "; ".join(filter(None, (remedy, again, narrowed)))


def _known_well(verdict: Verdict, parameters: Parameters) -> bool:
    """Whether the interval of the leading parameter of the strongest effect is narrow as it is."""
    own = next(iter(parameters.get(verdict.effects[0], {}).values()), None)
    return own is not None and own.high - own.low < KNOWN_WELL * abs(own.value)


def _check(confusable: Sequence[tuple[str, ...]]) -> str:
    """The checks of the rig that tell the first set of effects from each of the others."""
    first, *others = confusable
    told = dict[str, list[str]]()
    for other in others:
        told.setdefault(check_that_tells([first, other]), []).append(_together(other))
    return "; ".join(
        f"{check}: that distinguishes {_together(first)} from {', or from '.join(sets)}"
        for check, sets in told.items()
    )


def _together(names: Sequence[str]) -> str:
    """A set of effects in plain words."""
    *others, last = [LIBRARY[name].title for name in names] or ["the nominal rig"]
    return f"{', '.join(others)} and {last} at once" if others else last


def _narrowed(problem: FitProblem, verdict: Verdict) -> str:
    """The run that would narrow the leading parameter of the strongest effect; empty without time."""
    fit, effect = verdict.best.fit, LIBRARY[verdict.effects[0]]
    feasible = list(experiments(problem.log)) if not stopping() else []
    if not feasible:
        return ""
    found = narrowest(problem, fit, fit.parameterization.owners.index(effect.name), feasible)
    name = f"the {effect.parameters[0].name} of {effect.title}"
    if found.factor > WORTH_A_RUN:
        return f"no single run that this rig can do would narrow the interval of {name} by a tenth"
    return (
        f"to know {name} better, {found.experiment.words}: that would narrow its interval to about "
        f"{100 * found.factor:.0f} % of its width"
    )


def _tell_apart(problem: FitProblem, verdict: Verdict) -> str:
    if not verdict.rivals:
        return _check(verdict.confusable)
    one, other = verdict.best, verdict.rivals[0]
    found = best_experiment(problem, one.fit, other.fit, experiments(problem.log))
    names = [" with ".join(c.named) or "the nominal model" for c in (one, other)]
    apart = f"{names[0]} and {names[1]} would lie {found.separation:.1f} standard deviations apart"
    runs = (DECISIVE_SIGMA / max(found.separation, 1e-3)) ** 2
    if found.separation >= DECISIVE_SIGMA:
        return f"{found.experiment.words}: there {apart}"
    if runs <= MOST_RUNS:
        times = "once" if runs < _ONCE else f"about {runs:.0f} times"
        return f"{found.experiment.words}, {times}: in each run {apart}"
    return _only_sliding(problem, one.fit, other.fit, names) or (
        f"{check_that_tells([one.named, other.named])}: no run that this rig can do would tell "
        f"{names[0]} from {names[1]} (in the best, {found.experiment.words}, they would lie "
        f"{found.separation:.2f} standard deviations apart)"
    )


def _only_sliding(problem: FitProblem, one: Fit, other: Fit, names: Sequence[str]) -> str:
    """The sliding run that would tell two explanations apart, for a rig that seems to have no axis."""
    if has_axis(problem.log):
        return ""
    found = best_experiment(problem, one, other, sliding_experiments(problem.log))
    if found.separation < DECISIVE_SIGMA:
        return ""
    return (
        f"no turn of the base alone would tell {names[0]} from {names[1]}; if the rig can slide the "
        f"needle, {found.experiment.words}: there they would lie {found.separation:.1f} standard "
        "deviations apart"
    )


def _look_closer(problem: FitProblem, nominal: ResidualBreakdown, left: ResidualBreakdown) -> str:
    varied = "at two depths and two rates" if has_axis(problem.log) else _WITHOUT_AXIS
    return (
        "no effect of the library explains the residual. "
        f"That of the nominal model is {nominal.largest}; "
        f"that of the nearest explanation is {left.largest}: "
        f"repeat the phase in which the latter is largest alone, {varied}, to see what it depends on"
    )
