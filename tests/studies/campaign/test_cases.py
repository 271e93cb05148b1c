"""From a campaign to its cases."""

import numpy as np
import pytest

from models.errors import InvalidValue
from studies.campaign.campaign import read_campaign
from studies.campaign.cases import case_count, cases_of, check_values, pieces, varied_values


@pytest.fixture
def campaign(campaign_file):
    return read_campaign(campaign_file())


def test_grids_are_crossed_and_samples_go_round(campaign_file):
    grids = {"free_mm": {"grid": [1.0, 2.0]}, "inserted_mm": {"linspace": [10, 30, 3]}}
    campaign = read_campaign(campaign_file(vary=grids, samples=1))
    found = [tuple(varied_values(campaign, k).values()) for k in range(case_count(campaign))]
    assert found == [(f, i) for f in (1.0, 2.0) for i in (10.0, 20.0, 30.0)]


def test_a_case_is_the_same_whatever_the_number_of_samples_and_the_order(campaign):
    more = campaign.but(samples=10)
    assert (case_count(campaign), case_count(more)) == (6, 20)
    backwards = cases_of(more, range(5, -1, -1))
    assert cases_of(campaign, range(6)) == backwards[::-1]


def test_draws_are_those_of_the_seed_and_the_case(campaign):
    rng = np.random.default_rng(np.random.SeedSequence([7, 4]))
    assert varied_values(campaign, 4)["segments.0.turn_deg"] == rng.normal(60.0, 5.0)
    turns = [varied_values(campaign, k)["segments.0.turn_deg"] for k in range(6)]
    assert len(set(turns)) == 6
    assert varied_values(campaign.but(seed=8), 4) != varied_values(campaign, 4)


def test_values_are_those_of_the_protocol(campaign):
    (case,) = cases_of(campaign, [3])
    assert case.protocol.inserted_mm == 120.0 == case.varied["inserted_mm"]
    assert case.protocol.segments[0].turn_deg == case.varied["segments.0.turn_deg"]
    assert case.protocol.but(inserted_mm=100.0, segments=campaign.base.segments) == campaign.base


def test_pieces_are_all_cases_once(campaign):
    assert [list(piece) for piece in pieces(campaign.but(cases_per_piece=4))] == [[0, 1, 2, 3], [4, 5]]


def test_a_draw_that_the_protocol_refuses_is_a_case_with_its_error(campaign_file):
    wide = {"free_mm": {"normal": [10.0, 100.0]}}
    campaign = read_campaign(campaign_file(vary=wide, samples=20))
    check_values(campaign)
    cases = cases_of(campaign, range(20))
    for case in cases:
        possible = 0 <= case.varied["free_mm"] <= 310
        assert (case.refused is None) == possible == (case.protocol is not None)
    assert {case.refused is None for case in cases} == {True, False}


@pytest.mark.parametrize(
    ("path", "how", "said"),
    [
        ("segments.5.turn_deg", {"grid": [1.0]}, "a position from 0 to 1"),
        ("tissue.damping", {"grid": [1.0]}, "layers"),
        ("free_mm", {"grid": [10.0, -1.0]}, "-1.0"),
        ("free_mm", {"uniform": [10.0, 1000.0]}, "1000.0"),
        ("needle", {"choice": ["steel-1.27", "wood"]}, "wood"),
        ("discretisation.elements", {"uniform": [4.5, 8.0]}, "4.5"),
    ],
)
def test_a_path_or_a_value_that_is_not_possible_is_named_before_anything_runs(
    campaign_file, path, how, said
):
    campaign = read_campaign(campaign_file(vary={path: how}, samples=1))
    with pytest.raises(InvalidValue, match=said) as error:
        check_values(campaign)
    assert error.value.field == f"vary.{path}"


def test_one_path_inside_of_another_is_refused(campaign_file):
    both = {"tissue": {"grid": ["chicken"]}, "tissue.entry_friction_n_mm": {"grid": [1.0]}}
    with pytest.raises(InvalidValue, match="inside"):
        check_values(read_campaign(campaign_file(vary=both, samples=1)))
