"""What to run next: where two explanations are left, the run that would tell them apart."""

from diagnosis.evidence import Evidence
from diagnosis.next_experiment import DECISIVE, best_experiment
from diagnosis.verdict import Outcome, Verdict
from diagnosis.where import Where


def advise(evidence: Evidence, verdict: Verdict, where: Where) -> str:
    """A sentence or two; empty where nothing is left to tell apart."""
    if verdict.outcome is Outcome.UNDECIDED:
        return _tell_apart(evidence, verdict)
    if verdict.outcome is Outcome.UNKNOWN:
        return _look_closer(where)
    return ""


def _tell_apart(evidence: Evidence, verdict: Verdict) -> str:
    one, other = verdict.best, verdict.rivals[0]
    found = best_experiment(evidence, one.fit, other.fit)
    names = [" with ".join(c.named) for c in (one, other)]
    apart = f"{names[0]} and {names[1]} would lie {found.separation:.1f} standard deviations apart"
    runs = (DECISIVE / max(found.separation, 1e-3)) ** 2
    if found.separation >= DECISIVE:
        return f"{found.experiment.words}: there {apart}"
    if runs <= 100:
        return f"{found.experiment.words}, about {runs:.0f} times: in each run {apart}"
    return (
        f"no run that this rig can do would tell {names[0]} from {names[1]}: in the best, "
        f"{found.experiment.words}, they would lie {found.separation:.2f} standard deviations apart"
    )


def _look_closer(where: Where) -> str:
    phase = max(where.phase, key=lambda k: where.phase[k], default="")
    signal = max(where.signal, key=lambda k: where.signal[k], default="")
    return (
        f"no effect of the library explains the gap, which is largest in {signal} while {phase}: "
        "repeat that phase alone, at two depths and two rates, to see what it depends on"
    )
