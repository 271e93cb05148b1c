"""Twist along the shaft with each effect of an explanation alone, and with all."""

from collections.abc import Sequence

from diagnosis.fitting.parameterization import parameterization_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.twist import ShaftTwist, shaft_twist
from diagnosis.selection.candidate import Candidate
from diagnosis.stopping import stopping
from sim.needles.run import SimulationFailed


def twist_by_effect(
    problem: FitProblem, near: Candidate, effects: Sequence[str], moment: tuple[str, float]
) -> ShaftTwist | None:
    """Twist along the shaft at a moment, by the nominal rig, with each effect alone and with all.

    None if that cannot be simulated, or after a stop.
    """
    if stopping():
        return None
    rigs = {"nominal": NOMINAL}
    if len(effects) > 1:
        rigs |= {name: _alone(problem, near, name, effects) for name in effects}
    rigs["explained"] = near.fit.parameterization.rig(near.fit.x)
    try:
        return shaft_twist(problem.log, *moment, rigs)
    except SimulationFailed:
        return None


def _alone(problem: FitProblem, near: Candidate, name: str, effects: Sequence[str]) -> RigParameters:
    """The rig with one of several effects, and with the fitted nuisance parameters."""
    nuisance = [e for e in near.fit.parameterization.nuisance if e.name not in effects]
    alone = parameterization_of([name], nuisance, problem.library, problem.base)
    return alone.rig(alone.joined({e.name: near.fit.parts[e.name] for e in alone.all}))
