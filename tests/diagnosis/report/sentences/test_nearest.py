"""What comes nearest to an explanation of an unknown log."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import concluding
from free_forms import missing_with

from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart
from diagnosis.criteria.assessment import DIFFERING_SHARE
from diagnosis.report.sentences.nearest import (
    about_as_near,
    differing_motions,
    differing_trials,
    nearest,
)
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stopping import EarlyStop

SEARCH = EarlyStop(why="limit of 30 s", stage="fitting pairs", left_out=("pairs",), search=True)


def test_of_a_search_that_was_cut_short_the_nearest_is_that_of_what_was_tried(dry):
    found = replace(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()), stopped=SEARCH)
    assert "No explanation that was tried so far reaches the noise" in nearest(found)


def test_what_comes_nearest_is_told_of_an_unknown_log_alone(dry):
    assert nearest(dry.found) == ""
    said = nearest(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()))
    assert said.startswith(
        "Nearest: dry (Coulomb) friction along the shaft (coulomb_friction level 0.00"
    )
    assert "% of the power of the residual beyond noise" in said
    assert "the remaining residual is largest in " in said


ZEROED = ValuesByPart(
    effect="tip_angle_bias",
    parameter="bias",
    unit="deg",
    parts=("trial_01.csv", "trial_02.csv", "trial_03.csv"),
    values=(0.1, None, -2.4),
    gap_common=10.0,
    gap_own=5.0,
)
TURNING = replace(
    ZEROED,
    effect="damping_error",
    parameter="scale",
    unit="-",
    parts=("forwards", "backwards", "at rest"),
)


def with_values(found, **parts):
    near = replace(found.assessment.nearest, **parts)
    return replace(found, assessment=replace(found.assessment, nearest=near))


def test_what_differs_between_trials_is_told_with_its_values(dry):
    said = differing_trials(with_values(dry.found, by_trial=(ZEROED,)))
    assert "in tip_angle_bias.bias. With one value for each (0.1, not determined and -2.4 deg), " in said
    assert "the residual of all trials together falls from 10.0 σ to 5.00 σ" in said


def test_what_differs_between_motions_is_told_with_their_names(dry):
    said = differing_motions(with_values(dry.found, by_motion=(TURNING,)))
    assert "in damping_error.scale. With one value for each (0.1 forwards and -2.4 at rest), " in said


def test_parts_that_differ_no_more_than_what_is_missing_makes_them_are_not_said_to(dry):
    hardly = replace(ZEROED, gap_own=8.0)
    assert 0.3 < hardly.share < DIFFERING_SHARE
    found = with_values(dry.found, by_trial=(hardly,), by_motion=(hardly,))
    for said in (differing_trials, differing_motions):
        assert said(dry.found) == said(found) == ""


@pytest.mark.parametrize("closed", [True, False])
def test_where_a_law_closes_the_gap_nothing_has_to_differ(dry, closed):
    found = with_values(dry.found, by_trial=(ZEROED,), by_motion=(TURNING,))
    found = replace(found, missing=replace(missing_with(), closed=closed))
    for said in (differing_trials, differing_motions):
        assert bool(said(found)) is not closed


def test_what_comes_about_as_near_is_told_by_the_names_of_effects(dry):
    assert about_as_near(dry.found) == ""
    sets = (("stiction", "tip_drag"), ("entry_friction",))
    said = about_as_near(concluding(dry.found, as_near=sets))
    assert "decimated log: stiction + tip_drag; entry_friction. Their order means" in said


def test_nothing_comes_about_as_near_as_the_nominal_model(dry):
    found = concluding(dry.found, as_near=(("entry_friction",),))
    near = replace(found.assessment.nearest, effects=())
    assert about_as_near(replace(found, assessment=replace(found.assessment, nearest=near))) == ""
