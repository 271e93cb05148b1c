"""Where nothing explains a log: trials that begin wound up, as the best explanation shows.

A twist at the first sample is looked for before any model is known, against a nominal rig that begins
untwisted, and a weak one passes for an offset of the sensors. A bent needle that has come to rest, say,
is wound up by its own curvature. Beside an explanation it shows: what that leaves beyond noise lies in
the first moments of trials; or, with play in the chuck, until the base has turned by that, since the
needle may rest anywhere within it. Then all trials have a past, which is fitted, if the log is explained
so: first on the decimated log, and on the log itself what comes near the noise there, also with an
imperfection of a sensor, or a drift of one, which starts that are left had hidden.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.prepare import START_LEFT_BESIDE, START_LEFT_SHARE, START_LEFT_TIMES
from diagnosis.criteria.selection import EXCHANGE_GAP
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor, in_units_of
from diagnosis.fitting.nuisance import late_starts_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.nominal_replay import fitted_pasts
from diagnosis.prepare.needle_memory import time_constant_s
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.prepare.start.late_start_detection import begun_late
from diagnosis.replay.replay import replay
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.stages.sensors.imperfections import imperfections_beside_the_best
from diagnosis.selection.stages.stage import Stage, first_that_explains, near_fitted_again
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

Array = NDArray[np.float64]

STAGE = "starts of trials"


def starts_of_trials(state: SearchState, workers: Workers) -> SearchState:
    """The state with trials that may begin wound up, where only that explains the log."""
    state, explained = state.rechecked()
    if explained or share_at_the_start(state) < START_LEFT_SHARE:
        return state
    begun = _with_pasts(state)
    near = near_fitted_again(STAGE, state, begun, workers, EXCHANGE_GAP)
    again, explained = near.rechecked()
    if not explained:
        again, explained = imperfections_beside_the_best(STAGE, again, workers).rechecked()
    if not explained:
        return state.noting(
            noted(
                STAGE,
                Decision.DROPPED,
                "with trials that begin wound up, no explanation reaches the noise either",
            )
        )
    return again.noting(noted(STAGE, Decision.KEPT, "trials that begin wound up explain the log"))


def starts_and_more(others: Sequence[Stage]) -> Stage:
    """A stage: what else a recording may lack is asked once more of trials that may begin wound up.

    Args:
      others: stages that allow for it; the first that explains the log is kept.
    """

    def starts_and_another_imperfection(state: SearchState, workers: Workers) -> SearchState:
        state, explained = state.rechecked()
        if explained or share_at_the_start(state) < START_LEFT_BESIDE:
            return state
        begun = near_fitted_again(STAGE, state, _with_pasts(state), workers, EXCHANGE_GAP)
        found = first_that_explains(others, begun, workers)
        reason = "with such starts it explains the log"
        return found.noting(noted(STAGE, Decision.KEPT, reason)) if found else state

    return starts_and_another_imperfection


def share_at_the_start(state: SearchState) -> float:
    """Of what the best leaves beyond noise, the part in the first moments of trials."""
    problem, fit = state.problem, state.best.fit
    plain = in_units_of(problem, fit.by_trial, problem.noise.uncoloured)
    play_deg = fit.parameterization.rig(fit.x).backlash_deg
    first, whole = 0.0, 0.0
    for trial, parts in zip(problem.log.trials, by_trial_and_sensor(problem, plain), strict=True):
        until_s = _engaged_s(trial, play_deg) + START_LEFT_TIMES * _slowest_s(problem, trial)
        for _, time_s, left in parts:
            beyond = left**2 - 1.0
            first += float(beyond[time_s < until_s].sum())
            whole += float(beyond.sum())
    return first / whole if whole > 0.0 else 0.0


def _engaged_s(trial: PreparedTrial, play_deg: float) -> float:
    """Time from which on the needle turns with the base, wherever in the play it has rested.

    That is the end of a trial whose base turns by less than the play.
    """
    turned_deg = np.abs(trial.base_motion_deg - trial.base_motion_deg[0])
    engaged = np.flatnonzero(turned_deg >= play_deg)
    return float(trial.time_s[engaged[0] if engaged.size else -1])


def _slowest_s(problem: FitProblem, trial: PreparedTrial) -> float:
    inserted_mm, free_mm = float(trial.inserted_mm[0]), float(trial.free_mm[0])
    return time_constant_s(problem.log.rig, inserted_mm, free_mm, mode=1)


def _with_pasts(state: SearchState) -> SearchState:
    """The state of trials that all have a past, to which nothing but that has been fitted.

    Fits to the decimated log as it was are left out: its rows are others now.
    """
    problem = state.problem
    trials = tuple(
        trial if trial.late_start else begun_late(problem.log.rig, trial, 0.0)
        for trial in problem.log.trials
    )
    log = replace(problem.log, trials=trials)
    known = {effect.name for effect in problem.nuisance}
    pasts = tuple(effect for effect in late_starts_of(log) if effect.name not in known)
    problem = replace(problem, log=log, nuisance=(*problem.nuisance, *pasts))
    nominal = fitted_pasts(problem)
    rig = nominal.parameterization.rig(nominal.x)
    return replace(
        state,
        problem=problem,
        coarse=decimated(problem, replay(log, rig, problem.resolution), rig),
        nominal=nominal,
        candidates=(candidate(nominal),),
        singles=(),
        pairs=(),
        triples=(),
        checked=None,
    )
