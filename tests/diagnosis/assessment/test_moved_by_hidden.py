"""A named parameter that an unseen effect may move by much is told."""

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, log_of, turns

from diagnosis.assessment.detection_limits import DetectionLimit, detection_limits
from diagnosis.assessment.moved_by_hidden import moved_by_hidden
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.criteria.fitting import SCATTER
from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.workers import Workers


def limit(damping, offset):
    return DetectionLimit(
        parameters={"damping": damping}, beside={"inserted_offset": {"offset": offset}}
    )


def told(limits, *, value=-4.0, width=0.2):
    own = Interval(value=value, low=value - width / 2, high=value + width / 2, unit="mm")
    return list(moved_by_hidden(limits, {"inserted_offset": {"offset": own}}))


def test_the_effect_that_moves_it_most_is_told_with_its_strength():
    small, large = limit(0.05, -6.0), limit(0.13, -10.5)
    (warning,) = told({"coulomb_friction": small, "tip_drag": large})
    assert "inserted_offset offset would be -10.5 mm instead of -4: its interval assumes" in warning
    assert "(damping 0.13 N mm s / rad)" in warning


@pytest.mark.parametrize(
    ("offset", "width"),
    [(-4.5, 0.2), (-4.7, 0.1), (-5.5, 1.0)],
    ids=["within a few widths", "a small share of it", "within a few wide ones"],
)
def test_what_moves_by_little_is_not(offset, width):
    assert told({"tip_drag": limit(0.1, offset)}, width=width) == []


def test_a_limit_that_is_none_moves_nothing_nor_does_one_beside_other_effects():
    assert told({"tip_drag": DetectionLimit(parameters={})}) == []
    other = DetectionLimit(parameters={"damping": 0.1}, beside={"damping_error": {"scale": 2.0}})
    assert told({"tip_drag": other}) == []


def test_of_an_effect_that_contains_it_nothing_is_told():
    """Stiction is less where dry friction takes a part of it: that is no other explanation."""
    own = Interval(value=0.002, low=0.0019, high=0.0021, unit="N mm / mm")
    each = dict.fromkeys(("kinetic", "static", "stribeck"), own)
    beside = {"stiction": dict.fromkeys(each, 0.001)}
    hidden = DetectionLimit(parameters={"level": 0.001}, beside=beside)
    assert not [*moved_by_hidden({"coulomb_friction": hidden}, {"stiction": each})]
    kinetic, *_ = moved_by_hidden({"entry_friction": hidden}, {"stiction": each})
    assert "stiction kinetic would be 0.001 N mm / mm instead of 0.002" in kinetic


@pytest.mark.parametrize(("phase_deg", "told"), [(-170.0, False), (200.0, False), (100.0, True)])
def test_a_phase_is_the_same_a_turn_further(phase_deg, told):
    """From 175 deg, -170 is 15 on: seven widths of its interval, and no fifth of a turn."""
    own = Interval(value=175.0, low=174.0, high=176.0, unit="deg")
    torque = Interval(value=0.002, low=0.0019, high=0.0021, unit="N mm / mm")
    beside = {"needle_curvature": {"torque": 0.002, "phase": phase_deg}}
    hidden = DetectionLimit(parameters={"damping": 0.1}, beside=beside)
    named = {"needle_curvature": {"torque": torque, "phase": own}}
    assert bool([*moved_by_hidden({"tip_drag": hidden}, named)]) is told


def test_a_factor_has_no_unit():
    own = Interval(value=0.93, low=0.92, high=0.94, unit="-")
    hidden = DetectionLimit(parameters={"scale": 0.9}, beside={"tip_angle_scale": {"scale": 0.86}})
    (said,) = moved_by_hidden({"base_angle_scale": hidden}, {"tip_angle_scale": {"scale": own}})
    assert said.startswith("if the rig also had base_angle_scale (scale 0.9), which this log would not")
    assert "tip_angle_scale scale would be 0.86 instead of 0.93" in said


def test_less_inserted_length_answers_a_drag_at_the_tip():
    """The drag c of the last piece of shaft, c / beta, is nearly one with that piece."""
    shorter = RigParameters(inserted_offset_mm=-6.0, offset_free_share=1.0)
    coarse = coarse_of(log_of(shorter, seconds=12.0, angle=turns(12.0)))
    fit = fit_effects(coarse, ("inserted_offset",))
    limits = detection_limits(coarse, fit, fit, ("tip_drag", "tip_angle_bias"), Workers())
    own = {p.name: v for p, v in zip(fit.parameterization.parameters, fit.x, strict=True)}
    found_mm = 10.0 * own["offset"]
    drag = limits["tip_drag"].parameters["damping"]
    moved_mm = limits["tip_drag"].beside["inserted_offset"]["offset"] - found_mm
    beta = coarse.log.rig.tissue.damping_n_mm_s_per_mm
    assert moved_mm == pytest.approx(-drag / beta, rel=0.5)
    assert set(limits["tip_drag"].beside) == {"inserted_offset", *SCATTER}  # all that may be named
    assert np.abs(limits["tip_angle_bias"].beside["inserted_offset"]["offset"] - found_mm) < 0.5
