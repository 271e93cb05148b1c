"""What to run next: where two explanations are left, the run that would tell them apart."""

from collections.abc import Sequence

from diagnosis.assessment.experiments import experiments, has_axis, sliding_experiments
from diagnosis.assessment.next_experiment import best_experiment
from diagnosis.assessment.residual_breakdown import ResidualBreakdown
from diagnosis.criteria import DECISIVE_SIGMA, MOST_RUNS
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.verdict import Verdict, VerdictKind

_WITHOUT_AXIS = "at two rates and two amplitudes, with reversals and with rests of two lengths"


def advise(problem: FitProblem, verdict: Verdict, left: ResidualBreakdown) -> str:
    """A sentence or two; empty where nothing is left to tell apart.

    Args:
      problem: the decimated log, on which runs are simulated.
      left: what the best explanation leaves.
    """
    if verdict.kind is VerdictKind.UNDECIDED:
        return _tell_apart(problem, verdict)
    if verdict.kind is VerdictKind.UNKNOWN:
        return _look_closer(problem, left)
    return ""


def _tell_apart(problem: FitProblem, verdict: Verdict) -> str:
    one, other = verdict.best, verdict.rivals[0]
    found = best_experiment(problem, one.fit, other.fit, experiments(problem.log))
    names = [" with ".join(c.named) for c in (one, other)]
    apart = f"{names[0]} and {names[1]} would lie {found.separation:.1f} standard deviations apart"
    runs = (DECISIVE_SIGMA / max(found.separation, 1e-3)) ** 2
    if found.separation >= DECISIVE_SIGMA:
        return f"{found.experiment.words}: there {apart}"
    if runs <= MOST_RUNS:
        return f"{found.experiment.words}, about {runs:.0f} times: in each run {apart}"
    return _only_sliding(problem, one.fit, other.fit, names) or (
        f"no run that this rig can do would tell {names[0]} from {names[1]}: in the best, "
        f"{found.experiment.words}, they would lie {found.separation:.2f} standard deviations apart"
    )


def _only_sliding(problem: FitProblem, one: Fit, other: Fit, names: Sequence[str]) -> str:
    """What a rig that seems to have no axis cannot tell, and a needle that slides would."""
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


def _look_closer(problem: FitProblem, left: ResidualBreakdown) -> str:
    varied = "at two depths and two rates" if has_axis(problem.log) else _WITHOUT_AXIS
    return (
        f"no effect of the library explains the residual, which is largest {left.worst_part}: "
        f"repeat that phase alone, {varied}, to see what it depends on"
    )
