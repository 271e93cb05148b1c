"""Where dry friction leads: the angle by which it gives before it slides.

Asperities bend before they slide: dry friction is a spring up to the presliding angle, about 0.1 deg.
That of a rig may be half or twice as large, which leaves little, but of strong friction more than noise,
and other effects would take that up. So with the best set of effects, if it has dry friction and comes
near the noise, the angle is fitted. If that takes off clearly more than chance, all fits have it from
there on: those that lead, and those without dry friction, go on.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from diagnosis.criteria.selection import NEAR_FLOOR, PRESLIDING_LEAD, PRESLIDING_SPREAD
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.bearing import PRESLIDING_DEG
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.screening import screen
from diagnosis.selection.stages.stage import leading_fitted_again
from diagnosis.selection.state import SearchState
from diagnosis.workers import Failure, Task, Workers

STAGE = "presliding of dry friction"


def _sliding_after(rig: RigParameters, ratio: float) -> RigParameters:
    return replace(rig, presliding_deg=ratio * PRESLIDING_DEG)


ANGLE = Effect(
    name="presliding angle",
    title="the angle by which dry friction gives before it slides",
    place=Place.INTERFACE,
    parameters=(
        Parameter(
            name="ratio",
            unit="-",
            low=0.1,
            high=10.0,
            start=(0.8, 1.25),
            logarithmic=True,
            neutral=1.0,
            reported=False,
            prior_sigma=PRESLIDING_SPREAD,
        ),
    ),
    apply=_sliding_after,
)


def presliding_of_dry_friction(state: SearchState, workers: Workers) -> SearchState:
    """The state with the presliding angle that the log asks for, where dry friction leads."""
    best = state.best
    near = best.fit.cost <= NEAR_FLOOR * best.fit.samples
    if state.problem.log.presliding_deg is not None or not (near and _slides_dry(state, best)):
        return state
    asked = PRESLIDING_LEAD * max(1.0, best.fit.gap**2)
    open_angle = replace(state.problem, library={**state.problem.library, ANGLE.name: ANGLE})
    found = workers.each(STAGE, _with_the_angle, [_task(open_angle, best.fit, asked)])[0]
    if isinstance(found, Failure) or found is None or best.fit.cost - found.cost < asked:
        return state
    ratio = ANGLE.parameters[0].from_fit(float(found.parts[ANGLE.name][0]))
    return _with_angle(state, ratio * PRESLIDING_DEG, workers)


def _slides_dry(state: SearchState, one: Candidate) -> bool:
    return any(state.problem.library[name].slides_dry for name in one.names)


def _task(problem: FitProblem, base: Fit, asked: float) -> Task:
    return Task(effects=base.names, arguments=(problem, base, asked))


def _with_the_angle(problem: FitProblem, base: Fit, asked: float) -> Fit | None:
    """The fit of the same effects and the angle; None: it promises too little.

    Raises:
      SimulationFailed: the rig cannot be simulated with another angle.
    """
    promised = max(screen(problem, base, ANGLE.name), key=lambda one: one.gain)
    if promised.gain < asked:
        return None
    return fit_effects(problem, promised.names, promised.start, from_a_fit=True)


def _with_angle(state: SearchState, angle_deg: float, workers: Workers) -> SearchState:
    """The state of problems with this angle; fits without dry friction are as they were."""
    fine, coarse = (_sliding(problem, angle_deg) for problem in (state.problem, state.coarse))
    again, record = leading_fitted_again(STAGE, state, fine, workers)
    known = {frozenset(c.names) for c in again}
    others = [c for c in state.candidates if not (_slides_dry(state, c) or frozenset(c.names) in known)]
    why = f"dry friction gives by {angle_deg:.3g} deg before it slides"
    return replace(
        state, problem=fine, coarse=coarse, candidates=(*again, *others), checked=None
    ).noting(*record, noted(STAGE, Decision.KEPT, why))


def _sliding(problem: FitProblem, angle_deg: float) -> FitProblem:
    library = {name: _slid(effect, angle_deg) for name, effect in problem.library.items()}
    log = replace(problem.log, presliding_deg=angle_deg)
    return replace(problem, library=library, log=log)


def _slid(effect: Effect, angle_deg: float) -> Effect:
    if not effect.slides_dry:
        return effect
    return replace(effect, apply=partial(_applied, effect.apply, angle_deg))


def _applied(
    apply: Callable[..., RigParameters], angle_deg: float, rig: RigParameters, *values: float
) -> RigParameters:
    return replace(apply(rig, *values), presliding_deg=angle_deg)
