"""Explanations with an effect that hides along a valley."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import log_of, start_of_search

from diagnosis.assessment.detection_limits import DetectionLimit
from diagnosis.assessment.uncertainty import hidden_effects as module
from diagnosis.assessment.uncertainty.hidden_effects import start_beside, with_hidden_effects
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.stages import STAGES
from diagnosis.workers import Workers

OFFSET_MM, DRAG = -20.0, 0.5
NAMES = ("inserted_offset",)
BESIDE = DetectionLimit(
    parameters={"damping": DRAG},
    beside={"inserted_offset": {"offset": OFFSET_MM}, "damping_error": {"scale": 1.02}},
)


@pytest.fixture(scope="module")
def found():
    """A search that has come to the inserted length alone."""
    rig = RigParameters(inserted_offset_mm=OFFSET_MM, tip_drag_n_mm_s_per_rad=DRAG)
    state = nominal_rig(start_of_search(log_of(rig, seconds=12.0), effects=NAMES), Workers())
    return replace(state, candidates=(candidate(fit_effects(state.problem, NAMES)),))


def named(found):
    at = found.best.fit.parameterization.values(found.best.fit.x)[0]
    own = Interval(value=float(at), low=float(at) - 0.05, high=float(at) + 0.05, unit="mm")
    return {"inserted_offset": {"offset": own}}


def test_a_fit_begins_at_the_strength_of_the_hidden_effect_and_what_it_moves(found):
    problem, best = found.problem, found.best.fit
    x = start_beside(problem, best, "tip_drag", BESIDE)
    own = problem.parameterization((*NAMES, "tip_drag"))
    values = dict(zip([p.name for p in own.parameters], own.values(x), strict=True))
    assert values["damping"] == pytest.approx(DRAG)
    assert values["offset"] == pytest.approx(OFFSET_MM)
    scales = [v for o, v in zip(own.owners, own.values(x), strict=True) if o == "damping_error"]
    assert scales == pytest.approx([1.02] * len(scales))


def test_the_pair_is_fitted_from_there_and_leads_where_it_is_true(found):
    more = with_hidden_effects(found, found.best.fit, {"tip_drag": BESIDE}, named(found), Workers())
    (pair,) = [c for c in more.candidates if c.names == (*NAMES, "tip_drag")]
    assert more.best is pair
    assert pair.fit.cost < found.best.fit.cost - 10.0
    assert [entry.stage for entry in more.record if entry not in found.record] == [module.STAGE]
    assert module.STAGE in STAGES


def test_where_nothing_moves_what_is_named_nothing_is_fitted(found, monkeypatch):
    monkeypatch.setattr(module, "fit_all", pytest.fail)
    (interval,) = named(found)["inserted_offset"].values()
    here = replace(BESIDE, beside={"inserted_offset": {"offset": interval.value}})
    best = found.best.fit
    assert with_hidden_effects(found, best, {"tip_drag": here}, named(found), Workers()) is found
    assert with_hidden_effects(found, best, {}, named(found), Workers()) is found
