"""The search of a log, once more where counts were lost."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import TORQUE as DRIFT_SIZE
from lossy_logs import LOST_DEG, NAMES, read

from diagnosis.log.trial import TORQUE
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.motion.base_jumps import small_jumps
from diagnosis.selection import search_of_log as module
from diagnosis.selection.jumps_beside import STAGE
from diagnosis.selection.record import Decision
from diagnosis.selection.search_of_log import search_log
from diagnosis.stages import STAGES
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed


def drifting(trial, most):
    """A trial whose torque drifts by up to so many sigma."""
    course = most * DRIFT_SIZE * np.sin(2.0 * np.linspace(0.0, 1.0, len(trial.table)))
    return replace(trial, table=trial.table.assign(**{TORQUE: trial[TORQUE] + course}))


def noted(state):
    return [entry.decision for entry in state.record if entry.stage == STAGE]


def test_counts_that_an_effect_hides_from_the_nominal_rig_are_restored():
    log = read(LOST_DEG)
    before = replay_nominal(log)
    assert not any("lost counts" in warning for warning in before.log.warnings)
    nominal, found = search_log(log, before, NAMES, Workers())
    assert found.rechecked()[1]
    assert found.best.names == NAMES
    assert noted(found) == [Decision.KEPT]
    assert STAGE in STAGES
    (warning,) = [warning for warning in nominal.log.warnings if "lost counts" in warning]
    assert "trial_02.csv" in warning


def test_lost_counts_are_looked_for_before_what_takes_long(monkeypatch):
    """And not after it, where that led nowhere."""
    log = read(LOST_DEG)
    nominal = replay_nominal(log)
    monkeypatch.setattr(module, "OF_THE_RECORDING", (pytest.fail,))
    _, found = search_log(log, nominal, NAMES, Workers())
    assert found.best.names == NAMES
    asked = []
    monkeypatch.setattr(module, "_restored", lambda *_: asked.append(1) or log)
    for elsewhere in (False, True):
        other = [lambda state, _: replace(state, candidates=(replace(state.best),))] * elsewhere
        monkeypatch.setattr(module, "OF_THE_RECORDING", tuple(other))
        search_log(log, nominal, NAMES, Workers())
    assert len(asked) == 3


def test_counts_that_a_drift_of_the_torque_hides_are_restored():
    """Beside what the drift leaves they are little: one in each direction, so that it is no offset."""
    log = read(LOST_DEG)
    log = replace(log, trials=tuple(map(drifting, log.trials, (8.0, -5.0))))
    _, found = search_log(log, replay_nominal(log), NAMES, Workers())
    assert found.rechecked()[1]
    assert found.best.names == NAMES
    assert noted(found) == [Decision.KEPT]
    assert TORQUE in found.problem.noise.drifts


def test_what_explains_nothing_is_not_restored(monkeypatch):
    """No explanation holds without dry friction, whatever a jump promises to take off."""
    log = read(LOST_DEG)
    before = replay_nominal(log)
    monkeypatch.setattr(module, "jumps_beside", lambda *_: (small_jumps(log)[:1], 1e9))
    nominal, found = search_log(log, before, (), Workers())
    assert nominal is before
    assert not found.rechecked()[1]
    assert noted(found) == [Decision.DROPPED]


@pytest.mark.parametrize(("share", "searches"), [(0.29, 1), (0.31, 2)])
def test_the_log_is_searched_again_where_jumps_take_off_enough(share, searches, monkeypatch):
    log = read(LOST_DEG)
    before = replay_nominal(log)
    made, start = [], module._start
    monkeypatch.setattr(module, "_start", lambda *given: made.append(1) or start(*given))

    def beside(fit, _):
        return small_jumps(log)[:1], share * (fit.cost - fit.prior - fit.samples)

    monkeypatch.setattr(module, "jumps_beside", beside)
    search_log(log, before, (), Workers())
    assert len(made) == searches


def test_a_rig_that_cannot_be_simulated_with_what_was_restored_stays_as_it_was(monkeypatch):
    def fail(_):
        raise SimulationFailed("no step converges")

    log = read(LOST_DEG)
    before = replay_nominal(log)
    monkeypatch.setattr(module, "replay_nominal", fail)
    nominal, found = search_log(log, before, NAMES, Workers())
    assert nominal is before
    assert noted(found) == [Decision.FAILED]


def test_a_log_that_has_lost_none_is_searched_once(monkeypatch):
    log = read()
    before = replay_nominal(log)
    monkeypatch.setattr(module, "replay_nominal", pytest.fail)
    nominal, found = search_log(log, before, NAMES, Workers())
    assert nominal is before
    assert noted(found) == []
