"""Elastic tissue that goes along with a sliding shaft, where only that explains a log."""

import pytest
from diagnosis_fixtures import joined, log_of, start_of_search

from diagnosis.prepare.prepared_log import DRAGGED
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.laws.dragged_tissue import STAGE, tissue_that_goes_along
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.workers import Workers

STIFFNESS, TIME_S = 0.02, 0.3


def searched(dragged, speed):
    """Before and after the stage, of two trials of elastic tissue."""
    rig = RigParameters(
        tissue_stiffness_n_mm_per_rad_per_mm=STIFFNESS,
        tissue_time_constant_s=TIME_S,
        tissue_dragged_ratio=dragged,
    )
    log = joined(*(log_of(rig, seed=seed, speed=speed, seconds=8.0) for seed in (1, 2)))
    effects = ("tissue_viscoelasticity", "tip_drag")
    state = single_effects(start_of_search(log, effects=effects), Workers())
    return state, tissue_that_goes_along(state, Workers())


def explained(state):
    return state.rechecked()[1]


def decisions(state):
    return [e.decision for e in state.record if e.stage == STAGE and not e.effects]


def test_tissue_that_is_dragged_is_found_and_told():
    before, after = searched(dragged=1.0, speed=4.5)
    assert not explained(before)
    assert explained(after)
    assert after.best.names == ("tissue_viscoelasticity",)
    stiffness, time_s = after.best.fit.parameterization.values(after.best.fit.x)[:2]
    assert stiffness == pytest.approx(STIFFNESS, rel=0.05)
    assert time_s == pytest.approx(TIME_S, rel=0.1)
    assert decisions(after)[-1] is Decision.KEPT
    assert DRAGGED in after.problem.log.warnings
    assert DRAGGED not in before.problem.log.warnings


@pytest.mark.parametrize(("dragged", "speed"), [(0.0, 4.5), (1.0, 0.0)])
def test_where_the_log_is_explained_nothing_changes(dragged, speed):
    """Tissue that stays; and a needle that does not slide, for which both are one."""
    before, after = searched(dragged, speed)
    assert explained(before)
    assert after.candidates == before.candidates
    assert decisions(after) == []
