"""Results on disk: whole pieces, and those that are missing."""

import pandas as pd
import pytest

from models.errors import InvalidValue, OutputExists
from studies.campaign.campaign import read_campaign
from studies.campaign.results import ResultFolder


@pytest.fixture
def campaign(campaign_file):
    return read_campaign(campaign_file())


@pytest.fixture
def results(campaign, tmp_path):
    made = ResultFolder(folder=tmp_path / "out", campaign=campaign)
    made.begin()
    for piece in made.missing():
        made.write(piece, [row(case) for case in piece])
    return made


def row(case):
    status = {"status": "failed", "error": "why"} if case == 1 else {"status": "done"}
    return {"case": case, "inserted_mm": 80.0 + case, "largest_lag_deg": 0.1 * case} | status


def same_place(results, campaign):
    return ResultFolder(folder=results.folder, campaign=campaign)


def test_rows_come_back_as_they_were_written_by_any_reader_of_parquet(results):
    table = results.read()
    assert list(table["case"]) == list(range(6))
    assert list(table["largest_lag_deg"]) == [0.1 * case for case in range(6)]
    assert list(table["status"]) == ["done", "failed", *["done"] * 4]
    pd.testing.assert_frame_equal(pd.read_parquet(results.dataset), table)
    assert results.missing() == []


def test_a_second_campaign_in_the_folder_needs_resume_or_force(results):
    with pytest.raises(OutputExists, match="--resume"):
        results.begin()
    results.begin(resume=True)
    assert results.missing() == []
    results.begin(force=True)
    assert len(results.missing()) == 3


def test_another_campaign_is_refused_and_nothing_is_lost(results, campaign):
    before = results.read()
    with pytest.raises(InvalidValue, match="another campaign"):
        same_place(results, campaign.but(seed=8)).begin(resume=True)
    pd.testing.assert_frame_equal(results.read(), before)


def test_samples_may_grow_but_not_shrink(results, campaign):
    more = same_place(results, campaign.but(samples=5))
    more.begin(resume=True)
    assert more.missing() == [range(6, 8), range(8, 10)]
    with pytest.raises(InvalidValue, match="samples"):
        results.begin(resume=True)


def test_a_piece_that_was_not_full_is_missing_when_samples_grow(campaign_file, tmp_path):
    campaign = read_campaign(campaign_file(cases_per_piece=4))
    results = ResultFolder(folder=tmp_path / "out", campaign=campaign)
    results.begin()
    for piece in results.missing():
        results.write(piece, [row(case) for case in piece])
    assert same_place(results, campaign.but(samples=4)).missing() == [range(4, 8)]


@pytest.mark.parametrize("at", [0.0, 0.5, 1.0])
def test_a_piece_that_is_cut_short_is_missing(results, at):
    path = sorted(results.dataset.iterdir())[1]
    whole = path.read_bytes()
    path.write_bytes(whole[: int(at * (len(whole) - 1))])
    assert results.missing() == [range(2, 4)]


def test_a_piece_in_which_a_byte_of_a_column_changed_is_missing(results):
    path = sorted(results.dataset.iterdir())[1]
    content = bytearray(path.read_bytes())
    content[40] ^= 1  # of the first page, behind its header or in it
    path.write_bytes(content)
    assert results.missing() == [range(2, 4)]


def test_a_piece_of_another_campaign_is_missing(results, campaign):
    other = same_place(results, campaign.but(seed=8))
    assert len(other.missing()) == 3


def test_a_piece_that_could_not_be_written_leaves_no_file(results):
    before = sorted(results.dataset.iterdir())
    with pytest.raises(Exception, match="int"):
        results.write(range(6, 8), [{"case": "six"}])
    assert sorted(results.dataset.iterdir()) == before
