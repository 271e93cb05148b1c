"""The study of gelatin."""

import numpy as np
import pytest
from reference_fits import fit_with

from studies.published import gelatin_study
from studies.published.experiments.rig import WITH_FREE_LENGTH
from studies.published.fitting.hypothesis import of_gelatin
from studies.published.selection.hypothesis_set import HypothesisSet
from studies.published.selection.verdict import VerdictKind


def test_dry_friction_explains_the_torque_that_gelatin_holds(study):
    found = study.gelatin
    assert found.verdict.effects == ("coulomb_friction",)
    level, low, high = found.verdict.best.intervals()[0]
    # The numbers of docs/published-figures.md.
    assert (level, low, high) == pytest.approx((0.0060, 0.0053, 0.0068), abs=5e-5)
    # Table II's own line through the origin, torque per mm of depth, is within the interval.
    depth, torque = np.array([25.0, 50.0, 75.0, 100.0]), [0.17, 0.32, 0.49, 0.58]
    assert low < depth @ torque / (depth @ depth) < high


def test_an_offset_of_the_torque_does_not_explain_what_grows_with_depth(study):
    offset = next(f for f in study.gelatin.fits if f.hypothesis.names == ("torque_bias",))
    # The mean of the torques is what an offset can explain.
    (value, _, _), *_ = offset.intervals()
    assert value == pytest.approx(np.mean([0.17, 0.32, 0.49, 0.58]), rel=0.05)
    assert offset.p_value < 1e-6


def test_gelatin_is_fitted_in_the_order_of_aicc_with_the_set_ups_free_length(monkeypatch):
    class Fitter:
        def __init__(self, figures, replay):
            self.figures = figures

        def fit(self, hypothesis):
            assert hypothesis.base == WITH_FREE_LENGTH
            z = {(): 4.0, ("torque_bias",): 3.0, ("stiction",): 2.0}[hypothesis.names]
            return fit_with(hypothesis.names, z, base=hypothesis.base, parameters=1)

    monkeypatch.setattr(gelatin_study, "FigureFitter", Fitter)
    monkeypatch.setattr(gelatin_study, "compare_with_text", lambda *given: ())
    effects = tuple(map(of_gelatin, ("torque_bias", "stiction")))
    found = gelatin_study.study_gelatin(
        HypothesisSet(plastisol=(), pairs=lambda alone: [], gelatin=effects), None
    )
    assert [f.hypothesis.names[0] for f in found.fits] == ["stiction", "torque_bias"]
    assert found.verdict.kind is VerdictKind.UNKNOWN
