"""Detection limits beside what the rig has."""

import math
from dataclasses import replace

import pytest

from diagnosis.assessment.detection_limits import DetectionLimit
from diagnosis.effects import LIBRARY
from diagnosis.report.figures.detection_limits import describe_limits, draw_limits, limit_shares


def limited(found, **values):
    limits = {effect: DetectionLimit(parameters=own) for effect, own in values.items()}
    return replace(found, assessment=replace(found.assessment, detection_limits=limits))


def share(found, effect, **values):
    (one,) = limit_shares(limited(found, **{effect: values}))
    return one


def test_a_factor_counts_by_how_far_it_is_from_one(dry):
    assert share(dry.found, "tip_angle_scale", scale=0.99).share_percent == pytest.approx(1.0, rel=0.01)
    assert share(dry.found, "tip_angle_scale", scale=1.01).share_percent == pytest.approx(1.0, rel=0.01)


def test_play_counts_beside_the_largest_turn(dry):
    """Trials turn by 110, 60 and 120 deg (reference_log)."""
    one = share(dry.found, "chuck_backlash", gap=0.6)
    assert one.share_percent == pytest.approx(0.5, rel=0.01)
    assert one.reference == "the largest turn, 120 deg"


def test_dry_friction_counts_beside_the_peak_torque_over_the_inserted_length(dry):
    peak = max(abs(p["base_torque_n_mm"]).max() for p in dry.found.assessment.explained)
    one = share(dry.found, "coulomb_friction", level=0.01 * peak / 100.0)
    assert one.share_percent == pytest.approx(1.0)


def test_a_spring_counts_by_its_compliance(dry):
    soft = share(dry.found, "base_compliance", stiffness=100.0)
    stiff = share(dry.found, "base_compliance", stiffness=1000.0)
    assert soft.share_percent == pytest.approx(10 * stiff.share_percent)


@pytest.mark.parametrize("effect", LIBRARY.values(), ids=lambda e: e.name)
def test_every_effect_has_something_to_be_compared_with(dry, effect):
    one = share(dry.found, effect.name, **{p.name: p.start[0] for p in effect.reported})
    assert 0 < one.share_percent < math.inf
    assert one.reference


def test_limits_are_sorted_bars_on_a_logarithmic_axis_and_words(dry):
    axis = draw_limits(dry.found).axes[0]
    shares = limit_shares(dry.found)
    assert axis.get_xscale() == "log"
    assert [label.get_text() for label in axis.get_yticklabels()] == [one.effect for one in shares]
    ends = [bar.get_x() + bar.get_width() for bar in axis.patches]
    assert ends == pytest.approx(sorted(one.share_percent for one in shares))
    assert all(
        f"{one.effect} {one.share_percent:.2g} % of {one.reference}" in describe_limits(dry.found)
        for one in shares
    )


def test_what_may_have_any_strength_is_said_and_not_drawn(dry):
    found = limited(dry.found, tip_drag={}, torque_bias={"bias": 0.01})
    assert len(draw_limits(found).axes[0].patches) == 1
    assert "tip_drag any strength" in describe_limits(found)
