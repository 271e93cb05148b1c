"""What a diagnosis says in sentences."""

from dataclasses import replace

import pytest

from diagnosis.report.sentences import (
    headline,
    largest_residual,
    nearest,
    reduction,
    replay_quality,
    titles,
    with_one_more,
)
from diagnosis.selection.verdict import VerdictKind


def concluding(found, **verdict):
    """The diagnosis with another verdict."""
    return replace(found, verdict=replace(found.verdict, **verdict))


def test_what_explains_the_gap_is_the_headline(dry):
    gap = dry.found.assessment.gap
    expected = (
        "Dry (Coulomb) friction along the shaft explains the gap: residual "
        f"{gap.before:.2f} σ → {gap.after:.2f} σ (σ = sensor noise)"
    )
    assert headline(dry.found) == expected


TWO = ("tip_drag", "torque_bias")


@pytest.mark.parametrize(
    ("verdict", "said"),
    [
        ({"kind": VerdictKind.NONE, "effects": ()}, "No gap beyond noise: the nominal model explains"),
        ({"effects": TWO}, "explain the gap: residual"),
        (
            {"kind": VerdictKind.UNDECIDED, "confusable": (("tip_drag",), ("torque_bias",))},
            "Undecided: these explain the gap equally well:",
        ),
        ({"kind": VerdictKind.UNKNOWN, "effects": ()}, "Unknown: no effect of the library"),
    ],
)
def test_every_verdict_has_its_headline(dry, verdict, said):
    assert said in headline(concluding(dry.found, **verdict))


def test_what_comes_nearest_is_told_of_an_unknown_log_alone(dry):
    assert nearest(dry.found) == ""
    said = nearest(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()))
    assert said.startswith("Nearest: dry (Coulomb) friction along the shaft (level 0.00")
    assert "% of the power of the gap" in said
    assert "what is left is largest in " in said


def test_sets_that_fit_alike_are_told_in_words(dry):
    kind = VerdictKind.UNDECIDED
    said = headline(concluding(dry.found, kind=kind, confusable=(TWO, ("stiction",))))
    assert f"{titles(TWO)}; or {titles(('stiction',))}" in said


def test_the_reduction_is_told_with_its_interval(dry):
    gap = dry.found.assessment.gap
    said = reduction(dry.found)
    assert f"from {gap.before:.2f} σ to {gap.after:.3f} σ" in said
    assert f"{100 * gap.shrink_low:.1f} to {100 * gap.shrink_high:.1f} %" in said


def test_one_more_effect_that_changes_nothing_is_said_to(dry):
    found = dry.found
    assert "Adding another effect changes almost nothing" in with_one_more(found)
    here = found.verdict.best.fit.gap
    told = replace(found.assessment, with_one_more={"tip_drag": 0.5 * here})
    assert "would change" in with_one_more(replace(found, assessment=told))
    nothing = replace(found.assessment, with_one_more={})
    assert with_one_more(replace(found, assessment=nothing)) == ""


def test_noise_and_numerical_error_are_told_by_sensor(dry):
    lines = replay_quality(dry.found)
    assert [line.split(":")[0] for line in lines] == [
        "base_torque_n_mm",
        "tip_angle_deg",
        "base_angle_deg",
    ]
    assert "numerical error: 0.0" in lines[0]


def test_the_largest_residual_is_told_with_where_it_is(dry):
    stretch, value = dry.found.assessment.breakdown.worst
    assert largest_residual(dry.found) == f"Largest residual: {value:.2f} σ, {stretch}"
