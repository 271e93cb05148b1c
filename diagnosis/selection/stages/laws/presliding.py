"""Where dry friction leads: the angle by which it gives before it slides.

Asperities bend before they slide: dry friction is a spring up to the presliding angle, about 0.1 deg.
That of a rig may be half or twice as large, which leaves little, but of strong friction more than noise,
and other effects would take that up. So with the best set of effects, if it has dry friction and comes
near the noise, the angle is fitted. If that takes off more than chance, and than a further parameter
costs, the rig has it in all fits from there on. Leading explanations with dry friction are fitted again,
on the log itself and decimated; others with dry friction are dropped.

An angle that was fitted beside two effects takes up part of what a third does. So where a better set
asks for another angle later, it gets that; or the usual one, if that leaves little more.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from diagnosis.criteria.selection import NEAR_FLOOR, PRESLIDING_LEAD, PRESLIDING_SPREAD
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, RecordEntry, dropped, noted
from diagnosis.selection.screening import screen
from diagnosis.selection.stages.stage import leading_fitted_again, leading_sets, stopped_in
from diagnosis.selection.state import SearchState
from diagnosis.workers import Failure, Task, Workers
from sim.discretisation import PRESLIDING_DEG

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
    if not (near and _slides_dry(best)):
        return state
    asked = (PRESLIDING_LEAD + math.log(best.fit.samples)) * max(1.0, best.fit.gap**2)
    task = Task(effects=best.names, arguments=(state.problem, best.fit, asked))
    angle_deg = workers.each(STAGE, _better_angle_deg, [task])[0]
    if isinstance(angle_deg, Failure) or angle_deg is None:
        return state
    if angle_deg >= ANGLE.parameters[0].high * PRESLIDING_DEG:
        return state.noting(noted(STAGE, Decision.DROPPED, "the angle is beyond any of dry friction"))
    return _with_angle(state, angle_deg, workers)


def _slides_dry(one: Candidate) -> bool:
    return one.fit.parameterization.rig(one.fit.x).slides_dry


def _better_angle_deg(problem: FitProblem, base: Fit, asked: float) -> float | None:
    """The angle with which the same effects leave less, by a cost; None: there is none.

    Raises:
      SimulationFailed: the rig cannot be simulated with another angle.
    """
    open_angle = replace(problem, library={**problem.library, ANGLE.name: ANGLE})
    promised = screen(open_angle, base, ANGLE.name)[0]
    if promised.gain < asked:
        return None
    found = fit_effects(open_angle, promised.names, promised.start, from_a_fit=True)
    if base.cost - found.cost < asked:
        return None
    if problem.log.presliding_deg != PRESLIDING_DEG:
        usual = fit_effects(_sliding(problem, PRESLIDING_DEG), base.names, base.x, from_a_fit=True)
        if usual.cost - found.cost < asked:
            return PRESLIDING_DEG
    return ANGLE.parameters[0].from_fit(float(found.parts[ANGLE.name][0])) * PRESLIDING_DEG


def _with_angle(state: SearchState, angle_deg: float, workers: Workers) -> SearchState:
    """The state of problems with this angle; as it was, if a stop or a failure cuts that short."""
    fine, coarse = (_sliding(problem, angle_deg) for problem in (state.problem, state.coarse))
    again, record = leading_fitted_again(STAGE, state, fine, workers)
    sizes = [_fitted_again(own, coarse, workers) for own in (state.singles, state.pairs, state.triples)]
    record = (*record, *(entry for _, entries in sizes for entry in entries))
    if stopped := stopped_in(record):
        return state.noting(*stopped)
    if not any({*c.names} == {*state.best.names} for c in again):
        return state.noting(noted(STAGE, Decision.DROPPED, "the best cannot be simulated with it"))
    kept, out = _without_dry(state.candidates, again)
    singles, pairs, triples = (found for found, _ in sizes)
    why = f"dry friction gives by {angle_deg:.3g} deg before it slides"
    return replace(
        state,
        problem=fine,
        coarse=coarse,
        candidates=(*again, *kept),
        singles=singles,
        pairs=pairs,
        triples=triples,
        checked=None,
    ).noting(*record, *out, noted(STAGE, Decision.KEPT, why))


def _sliding(problem: FitProblem, angle_deg: float) -> FitProblem:
    return replace(problem, log=replace(problem.log, presliding_deg=angle_deg))


def _fitted_again(
    found: Sequence[Candidate], coarse: FitProblem, workers: Workers
) -> tuple[tuple[Candidate, ...], tuple[RecordEntry, ...]]:
    """Sets of the decimated log, those with dry friction fitted again if they lead, best first."""
    leading = leading_sets([c for c in found if _slides_dry(c)])
    calls = [(coarse, c.names, coarse.parameterization(c.names).joined(c.fit.parts)) for c in leading]
    again, record = fit_all(STAGE, calls, workers) if calls else ([], ())
    kept, out = _without_dry(found, again)
    return tuple(sorted([*again, *kept], key=lambda c: c.score)), (*record, *out)


def _without_dry(
    found: Sequence[Candidate], again: Sequence[Candidate]
) -> tuple[list[Candidate], tuple[RecordEntry, ...]]:
    """Those of an earlier angle that hold at any, and the record of the others."""
    known = {frozenset(c.names) for c in again}
    others = [c for c in found if frozenset(c.names) not in known]
    out = [c for c in others if _slides_dry(c)]
    why = "far behind the best, with dry friction that gives by another angle"
    return [c for c in others if c not in out], dropped(STAGE, out, why)
