"""Every effect is screened; the promising are fitted."""

import numpy as np
from diagnosis_fixtures import log_of, start_of_search

from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.record import Decision
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.stages import single_effects as module
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed


def test_every_effect_is_tried_and_the_best_is_fitted_to_the_log_itself(dry_start):
    begun = nominal_rig(dry_start, Workers())
    found = single_effects(begun, Workers())
    assert {e.effects[0] for e in found.record if len(e.effects) == 1} == set(dry_start.effects)
    assert found.singles[0].names == ("coulomb_friction",)
    assert ("coulomb_friction",) in [c.names for c in found.candidates]
    assert found.best.floor.reached


def test_what_was_fitted_before_starts_from_where_it_was(dry_start, monkeypatch):
    begun = single_effects(nominal_rig(dry_start, Workers()), Workers())
    ends = {c.names: c.fit.x for c in begun.singles}
    starts = []

    def fitted(stage, problem, screened, *others, **known):
        starts.extend(screened)
        return fit_screened(stage, problem, screened, *others, **known)

    monkeypatch.setattr(module, "fit_screened", fitted)
    again = single_effects(begun, Workers())
    assert len(ends) > 1
    for names, x in ends.items():
        (start,) = [s.start for s in starts if s.names == names]
        np.testing.assert_array_equal(start, x)
    assert again.singles[0].names == begun.singles[0].names
    assert again.singles[0].fit.cost <= begun.singles[0].fit.cost


def test_what_promises_too_little_beside_noise_alone_is_not_fitted(still_start):
    found = single_effects(nominal_rig(still_start, Workers()), Workers())
    out = [e for e in found.record if e.reason == "screening promises too little"]
    assert out
    assert not {e.effects for e in out} & {c.names for c in found.singles}


def test_beside_a_damping_that_is_off_by_little_everything_is_fitted():
    """Scatter of the constants has taken it over: screened beside that, nothing promises anything."""
    log = log_of(RigParameters(damping_scale=1.02), speed=-1.0, seed=1)
    start = start_of_search(log, ("damping_error", "tip_drag", "torque_bias"))
    found = single_effects(nominal_rig(start, Workers()), Workers())
    assert {c.names[0] for c in found.singles} == set(start.effects)


def test_where_the_decimated_log_cannot_be_fitted_the_state_stays(still_start, monkeypatch):
    monkeypatch.setattr(module, "fit_effects", failing)
    found = single_effects(still_start, Workers())
    assert found.candidates == still_start.candidates
    assert [e.decision for e in found.record] == [Decision.FAILED]


def failing(*_, **__):
    """What cannot be simulated at all."""
    raise SimulationFailed("the simulation lost its numbers")
