"""The study of gelatin."""

import numpy as np
import pytest

from studies.published.experiments.replay import FigureReplay
from studies.published.fitting.hypothesis import of_gelatin
from studies.published.gelatin_study import study_gelatin
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


def test_an_offset_of_the_torque_does_not_explain_what_grows_with_depth():
    offset = HypothesisSet(plastisol=(), pairs=lambda alone: [], gelatin=(of_gelatin("torque_bias"),))
    found = study_gelatin(offset, FigureReplay())
    assert found.verdict.kind is VerdictKind.UNKNOWN
    # The mean of the torques is what an offset can explain.
    (value, _, _), *_ = found.verdict.best.intervals()
    assert value == pytest.approx(np.mean([0.17, 0.32, 0.49, 0.58]), rel=0.05)


def test_gelatin_is_fitted_in_the_order_of_aicc(study):
    assert [f.hypothesis.names[0] for f in study.gelatin.fits] == ["coulomb_friction", "torque_bias"]
    assert [f.aicc for f in study.gelatin.fits] == sorted(f.aicc for f in study.gelatin.fits)
