"""The search of a log, and once more where its encoder has lost counts that only an explanation shows.

An effect that is missing hides what lost counts do to the readings from the nominal rig; beside what the
search has found it shows: once the effects are tried, before anything else that a recording may have,
which takes long, and at the end, if that led elsewhere. What is restored so counts only where it brings
an explanation to the noise.
"""

from dataclasses import replace

from diagnosis.criteria.faults import LOST_COUNTS_SHARE
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.noise_reestimation import in_units_of
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import TORQUE
from diagnosis.lost_counts import with_jumps_restored
from diagnosis.nominal_replay import NominalReplay, replay_nominal
from diagnosis.prepare.motion.base_jumps import small_jumps
from diagnosis.selection.jumps_beside import STAGE, jumps_beside, shifted_back
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.scoring.drift_evidence import in_noise, wide_drifts
from diagnosis.selection.search import OF_EFFECTS, OF_THE_RECORDING, search
from diagnosis.selection.stages.sensors.sensor_drift import promises
from diagnosis.selection.stages.stage import run_stages
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed


def search_log(
    log: RigLog, nominal: NominalReplay, effects: tuple[str, ...], workers: Workers
) -> tuple[NominalReplay, SearchState]:
    """The search for an explanation of a log, and the nominal replay that it is beside.

    Args:
      log: as it was read.
      nominal: its nominal replay.
      effects: that may be tried.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated on the log as it was read.
    """
    begun = run_stages(OF_EFFECTS, _start(nominal, effects), workers)
    begun, anew = _beside_counts(log, begun, effects, workers)
    if anew:
        return anew
    found = run_stages(OF_THE_RECORDING, begun, workers)
    if found.best is begun.best:
        return nominal, found
    found, anew = _beside_counts(log, found, effects, workers)
    return anew or (nominal, found)


def _start(nominal: NominalReplay, effects: tuple[str, ...]) -> SearchState:
    problem = nominal.problem
    return SearchState(
        problem=problem,
        coarse=decimated(problem, nominal.predictions, nominal.rig),
        effects=effects,
        nominal=nominal.fit,
    )


def _beside_counts(
    log: RigLog, found: SearchState, effects: tuple[str, ...], workers: Workers
) -> tuple[SearchState, tuple[NominalReplay, SearchState] | None]:
    """The state, noted; and another nominal replay and search, if lost counts are what it lacks."""
    found, explained = found.rechecked()
    if explained or workers.stop.left_out:
        return found, None
    restored = _restored(log, found, workers)
    if restored is log:
        return found, None
    try:
        anew = replay_nominal(restored)
        again, explained = search(_start(anew, effects), workers).rechecked()
    except SimulationFailed as failed:
        return found.noting(noted(STAGE, Decision.FAILED, str(failed))), None
    if not explained:
        why_not = "no explanation reaches the noise with them restored"
        return found.noting(noted(STAGE, Decision.DROPPED, why_not)), None
    entry = noted(STAGE, Decision.KEPT, "beside an explanation the encoder of the base has lost counts")
    return found, (anew, again.noting(entry))


def _restored(log: RigLog, found: SearchState, workers: Workers) -> RigLog:
    """The log with counts restored that were lost beside the best explanation; itself: too few were.

    A drift of the torque may leave so much more that they are a small part of it.
    """
    steady = found.problem.noise
    drifting = [
        noise for noise in wide_drifts(found.problem, TORQUE)[-1:] if promises(found, noise, found.best)
    ]
    each = shifted_back(found.problem, found.best.fit, small_jumps(log), workers)
    for noise in (steady, *drifting):
        fit = in_noise(found.best, found.problem, noise).fit
        beyond = sum(float(r @ r) for r in fit.by_trial) - fit.samples
        changes = [replace(own, change=in_units_of(found.problem, own.change, noise)) for own in each]
        jumps, taken_off = jumps_beside(fit, changes)
        if taken_off > LOST_COUNTS_SHARE * beyond:
            return with_jumps_restored(log, jumps)
    return log
