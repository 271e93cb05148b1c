"""Which effect, or which pair of them, explains a log: the stages of the search, in order.

Every effect of the vocabulary is screened, and the most promising are fitted, on the decimated
log; the best of these are then fitted on the log itself. If none of them brings the residual to the
noise floor, every pair of a leading effect with any other is screened, and so on as before. If one
does, but a second effect promises to take more off than noise could, that pair is fitted as well.
What the scatter of the rig's own constants explains is `none`.

Each stage takes the state of the search and returns the next; its record says what it made, kept and
dropped.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import (
    CONTENDING,
    FINALISTS,
    IMPERFECT_BASES,
    MOST_PAIRS,
    NEAR_FLOOR,
    NOMINAL_LEAD,
    PAIR_BASES,
    SCATTER,
    SECOND_LEAVES,
    WORTH_FITTING,
)
from diagnosis.effects import FITTED, IMPERFECTIONS
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.fit_status import Termination
from diagnosis.fitting.noise_reestimation import with_colour
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.fitting import fit_all, fit_each_alone, fit_finalists, fit_screened
from diagnosis.selection.mesh_refinement import refined_mesh
from diagnosis.selection.record import Decision, RecordEntry, dropped, failed, kept, not_fitted
from diagnosis.selection.screening import Screened, screen
from diagnosis.selection.state import SearchState
from diagnosis.selection.torque_drift import with_drift
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]
Stage = Callable[[SearchState, Workers], SearchState]


def search(state: SearchState, workers: Workers) -> SearchState:
    """The state after all stages; where nothing explains the log, with drift of the torque as well."""
    return with_drift(_all_stages(state, workers), workers, _all_stages)


def _all_stages(state: SearchState, workers: Workers) -> SearchState:
    """The state after all stages."""
    return _stages(STAGES, state, workers)


def _stages(stages: Sequence[Stage], state: SearchState, workers: Workers) -> SearchState:
    """The state after those stages that there was time for; the nominal rig is in any."""
    for stage in stages:
        if workers.stop.due and state.candidates:
            workers.stop.leave_out(stage.__name__.replace("_", " "))
        else:
            state = stage(state, workers)
    return state


def nominal_rig(state: SearchState, workers: Workers) -> SearchState:
    """The nominal rig, and the nominal rig with its scatter if that is needed."""
    stage = "nominal rig"
    exact = candidate(state.nominal)
    state = state.adding(([exact], kept(stage, [exact], "as rig.yaml says")))
    scattered, record = fit_all(stage, [(state.problem, ())], workers)
    enough = exact.floor.reached and all(exact.score <= s.score + NOMINAL_LEAD for s in scattered)
    if enough:
        return state.noting(*record, *dropped(stage, scattered, "the exact nominal rig is as good"))
    return state.adding((scattered, record))


def stiffness_or_damping_alone(state: SearchState, workers: Workers) -> SearchState:
    """Where only the ratio of both shows, each alone."""
    for one in [c for c in state.candidates if c.unidentifiable]:
        made = fit_each_alone("stiffness or damping alone", state.problem, one, SCATTER, workers)
        state = state.adding(made)
    return state


def single_effects(state: SearchState, workers: Workers) -> SearchState:
    """Every effect screened, the promising fitted on the decimated log, the best on the log itself."""
    stage = "single effects"
    alone = [Task(effects=(), arguments=(state.coarse, ()))]
    (start,) = workers.each(f"screening {stage}", fit_effects, alone)
    if isinstance(start, Failure):
        return state.noting(*failed(stage, [start]))
    screened, record = _screened(
        stage, [(state.coarse, start, effect) for effect in state.effects], workers
    )
    state = state.noting(*record)
    # Where something is missing, scatter has taken over a part of it, and screening may be blind.
    missing = not candidate(start).floor.small
    worth = [s for s in screened if missing or s.gain >= WORTH_FITTING]
    state = state.noting(*_not_worth(stage, screened, worth))
    singles, record = fit_screened(stage, state.coarse, worth, len(worth), workers, used=PAIR_BASES)
    state = replace(state.noting(*record), singles=tuple(singles))
    return state.adding(fit_finalists("finalists", state.problem, singles, workers))


def coloured_noise(state: SearchState, workers: Workers) -> SearchState:
    """The noise as the best effect leaves it; where other sensors' is coloured, all once more."""
    noise = with_colour(state.problem, state.best.fit)
    if noise.same(state.problem.noise):
        return state
    again = state.renoised(noise)
    if noise.colour.keys() == state.problem.noise.colour.keys():
        return again
    out = dropped("coloured noise", state.candidates, "the noise has another colour")
    again = replace(again, candidates=(), singles=()).noting(*out)
    again = _stages((nominal_rig, stiffness_or_damping_alone, single_effects), again, workers)
    if workers.stop.due and not again.singles:
        return state.noting(*_stopped(again.record[len(state.record) :]))  # no effect was fitted
    return again


def finer_mesh_near_the_floor(state: SearchState, workers: Workers) -> SearchState:
    """A finer mesh where that may be all that is missing: it makes what follows many times dearer."""
    near = state.best.fit.gap**2 <= NEAR_FLOOR
    return finer_mesh(state, workers) if near else state


def finer_mesh(state: SearchState, workers: Workers) -> SearchState:
    """A replay as fine as the log asks, and candidates fitted to it."""
    problem, found, record = refined_mesh(state.problem, state.candidates, workers)
    if stopped := _stopped(record):
        return state.noting(*stopped)  # costs at two resolutions do not compare
    return replace(state, problem=problem, candidates=tuple(found)).noting(*record)


def pairs(state: SearchState, workers: Workers) -> SearchState:
    """Pairs, where no effect alone explains the log, or where a second promises enough."""
    stage = "pairs"
    state, alone = state.rechecked()
    bases = product(state.singles[: 1 if alone else PAIR_BASES], state.effects)
    calls = [(state.coarse, base.fit, effect) for base, effect in bases if effect not in base.names]
    screened, record = _screened(stage, calls, workers)
    state = state.noting(*record)
    worth = [s for s in screened if _worth_a_second(s, state, alone=alone)]
    fitted, record = fit_screened(stage, state.coarse, worth, MOST_PAIRS, workers)
    state = state.noting(*_not_worth(stage, screened, worth), *record)
    state = replace(state, pairs=tuple(fitted))
    found, record = fit_finalists("finalists, pairs", state.problem, fitted, workers)
    enough = _takes_off_enough(found, state) if alone and state.singles else found
    out = [c for c in found if c not in enough]
    reason = f"its second effect leaves more than {SECOND_LEAVES:g} of the cost of one alone"
    return state.adding((enough, (*record, *dropped("finalists, pairs", out, reason))))


def richer_effects(state: SearchState, workers: Workers) -> SearchState:
    """Where nothing explains the log: effects that contain one of a leading set, from where that is.

    Fitted from far off they may have ended in a local minimum, above what they contain.
    """
    stage = "richer effects"
    leading = sorted((*state.singles, *state.pairs), key=lambda c: c.score)[:FINALISTS]
    inner = next((c for c in leading if _richer(c, state.effects)), None)
    if inner is None or state.rechecked()[1]:
        return state
    enough = leading[0].score + CONTENDING
    calls = [
        (state.coarse, names, start, enough)
        for simple, rich in _richer(inner, state.effects)
        for names, start in _starts_beyond(state.coarse, inner, simple, rich)
    ]
    fitted, record = fit_all(stage, calls, workers)
    ahead = sorted((c for c in fitted if c.score < leading[0].score), key=lambda c: c.score)
    state = replace(state.noting(*record), pairs=(*state.pairs, *ahead[:1]))
    return state.adding(fit_finalists(f"finalists, {stage}", state.problem, ahead[:1], workers))


def one_more_imperfection(state: SearchState, workers: Workers) -> SearchState:
    """Where nothing explains the log: one effect at most, with two imperfections of sensors."""
    stage = "imperfections of sensors"
    state, explained = state.rechecked()
    if explained:
        return state
    rough = [c for c in state.pairs if any(name in IMPERFECTIONS for name in c.names)]
    more = [name for name in state.effects if name in IMPERFECTIONS]
    bases = product(rough[:IMPERFECT_BASES], more)
    calls = [(state.coarse, base.fit, name) for base, name in bases if name not in base.names]
    screened, record = _screened(stage, calls, workers)
    worth = [s for s in screened if s.gain >= WORTH_FITTING]
    fitted, fits = fit_screened(stage, state.coarse, worth, MOST_PAIRS, workers)
    state = state.noting(*record, *_not_worth(stage, screened, worth), *fits)
    return state.adding(fit_finalists(f"finalists, {stage}", state.problem, fitted, workers))


def best_to_its_end(state: SearchState, workers: Workers) -> SearchState:
    """The fit of the best, where it was given up for staying far above the noise."""
    best = state.best
    if best.fit.status.termination is not Termination.BEHIND:
        return state
    return state.adding(fit_all("best to its end", [(state.problem, best.names, best.fit.x)], workers))


def effects_of_the_best_alone(state: SearchState, workers: Workers) -> SearchState:
    """Each effect of a leading pair alone: the other may have been a crutch."""
    best = state.best
    if len(best.names) < 2:
        return state
    return state.adding(
        fit_each_alone("effects of the best alone", state.problem, best, best.names, workers)
    )


def scatter_of_the_best(state: SearchState, workers: Workers) -> SearchState:
    """What the best names of stiffness and damping, without the prior of scatter that pulls it."""
    best = state.best
    if not best.scatter_named:
        return state
    names = (*best.names, *best.scatter_named)
    start = state.problem.parameterization(names).joined(best.fit.parts)
    return state.adding(fit_all("scatter of the best", [(state.problem, names, start)], workers))


STAGES: tuple[Stage, ...] = (
    nominal_rig,
    stiffness_or_damping_alone,
    single_effects,
    coloured_noise,
    finer_mesh_near_the_floor,
    pairs,
    richer_effects,
    one_more_imperfection,
    best_to_its_end,
    effects_of_the_best_alone,
    scatter_of_the_best,
    finer_mesh,
)


def _stopped(record: Sequence[RecordEntry]) -> list[RecordEntry]:
    return [entry for entry in record if entry.decision is Decision.STOPPED]


def _screened(
    stage: str, calls: Sequence[tuple[FitProblem, Fit, str]], workers: Workers
) -> tuple[list[Screened], tuple[RecordEntry, ...]]:
    tasks = [
        Task(effects=(*base.names, name), arguments=(problem, base, name))
        for problem, base, name in calls
    ]
    results = workers.each(f"screening {stage}", screen, tasks)
    found = [s for own in results if not isinstance(own, Failure) for s in own]
    return found, failed(stage, [r for r in results if isinstance(r, Failure)])


def _not_worth(
    stage: str, screened: Sequence[Screened], worth: Sequence[Screened]
) -> tuple[RecordEntry, ...]:
    fitted = {s.names for s in worth}
    out = dict.fromkeys(s.names for s in screened if s.names not in fitted)
    return not_fitted(stage, out, "screening promises too little")


def _worth_a_second(one: Screened, state: SearchState, *, alone: bool) -> bool:
    if not alone:
        return one.gain >= WORTH_FITTING
    return one.cost < SECOND_LEAVES * state.singles[0].fit.cost


def _richer(one: Candidate, effects: Sequence[str]) -> list[tuple[str, str]]:
    """Effects of a candidate, each with one that contains it and is not there."""
    others = [name for name in effects if name not in one.names]
    return [(inner, rich) for inner in one.names for rich in others if inner in FITTED[rich].contains]


def _starts_beyond(
    problem: FitProblem, one: Candidate, simple: str, rich: str
) -> list[tuple[tuple[str, ...], Array]]:
    """The candidate's set with a richer effect in place of a simple one, and where its fit may start."""
    names = tuple(rich if name == simple else name for name in one.names)
    values = [
        p.from_fit(float(v))
        for p, v in zip(problem.library[simple].parameters, one.fit.parts[simple], strict=True)
    ]
    effect, parameterization = problem.library[rich], problem.parameterization(names)
    found = []
    for start in effect.contains[simple](*values):
        own = np.array([p.to_fit(v) for p, v in zip(effect.parameters, start, strict=True)])
        found.append((names, parameterization.joined({**one.fit.parts, rich: own})))
    return found


def _takes_off_enough(found: Sequence[Candidate], state: SearchState) -> list[Candidate]:
    """Pairs that take off the log itself what a second effect has to promise on the decimated one."""
    asked = (1 - SECOND_LEAVES) * state.singles[0].fit.cost
    most = min(c.fit.cost for c in state.candidates) - asked
    return [c for c in found if c.fit.cost <= most]
