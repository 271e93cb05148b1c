"""A campaign to its end, and on from where it was ended."""

import time

import pytest
from campaigns import start_command

from diagnosis.engines.local import on_this_machine
from models.errors import InvalidValue
from studies.campaign.campaign import read_campaign
from studies.campaign.results import ResultFolder
from studies.campaign.run import run_campaign
from studies.campaign.run_case import job_of


@pytest.fixture
def results(campaign_file, tmp_path):
    return ResultFolder(folder=tmp_path / "out", campaign=read_campaign(campaign_file()))


def test_a_campaign_tells_how_far_it_is_and_what_failed(campaign_file, tmp_path):
    wide = {"free_mm": {"grid": [10.0, 20.0]}, "inserted_mm": {"normal": [300.0, 100.0]}}
    campaign = read_campaign(campaign_file(vary=wide))
    results, news = ResultFolder(folder=tmp_path / "out", campaign=campaign), []
    done = run_campaign(results, on_this_machine(1), progress=news.append)
    table = results.read()
    assert [n.done for n in news] == [0, 2, 4, 6]
    assert done.computed == 6
    assert done.failed == (table["status"] == "failed").sum()
    assert 0 < done.failed < 6
    assert f"({done.failed} failed)" in news[-1].stage
    assert table["error"].isna().sum() == 6 - done.failed


def test_resuming_computes_what_is_missing_alone(results):
    def one_piece(job, missing):
        yield from on_this_machine(1)(job, missing[:1])

    with pytest.raises(InvalidValue, match="missing"):
        run_campaign(results, one_piece, progress=lambda news: None)
    done = run_campaign(results, on_this_machine(1), resume=True, progress=lambda news: None)
    assert done.computed == 4
    again = run_campaign(results, on_this_machine(1), resume=True, progress=lambda news: None)
    assert again.computed == 0


def test_values_are_checked_before_anything_is_written(campaign_file, tmp_path):
    campaign = read_campaign(campaign_file(vary={"free_mm": {"uniform": [-1.0, 5.0]}}))
    results = ResultFolder(folder=tmp_path / "out", campaign=campaign)
    with pytest.raises(InvalidValue, match="free_mm"):
        run_campaign(results, on_this_machine(1), progress=lambda news: None)
    assert not results.folder.exists()


@pytest.mark.slow
def test_a_command_that_is_killed_on_the_way_goes_on_where_it_was(campaign_file, tmp_path, results):
    long = {"samples": 40, "cases_per_piece": 4, "base": "fig5-10cm"}
    path, out = campaign_file(**long), tmp_path / "killed"
    command = start_command(path, "--out", out, "--workers", "2")
    deadline = time.monotonic() + 120
    while not list(out.glob("results/piece-*.parquet")) and time.monotonic() < deadline:
        time.sleep(0.02)
    command.kill()
    command.wait()
    killed = ResultFolder(folder=out, campaign=read_campaign(path))
    kept = set(killed.dataset.glob("piece-*"))
    missing = killed.missing()
    assert 0 < len(missing) < 20
    assert start_command(path, "--out", out, "--resume").wait() == 0
    assert killed.missing() == []
    assert kept <= set(killed.dataset.iterdir())
    for piece in missing[:1]:
        ((_, wanted),) = on_this_machine(1)(job_of(killed.campaign), [piece])
        found = killed.read().iloc[list(piece)].to_dict("records")
        assert [row["largest_lag_deg"] for row in found] == [row["largest_lag_deg"] for row in wanted]
