"""`needle campaign` from the console."""

import pandas as pd
import pytest
import yaml
from campaigns import ROOT, content

from scripts.main import main
from sim.files import claiming


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "few.yaml"
    file.write_text(yaml.safe_dump(content()))
    return file


def needle_campaign(path, out, *more):
    return main(["campaign", str(path), "--out", str(out), "--workers", "1", *more])


def test_a_campaign_writes_results_and_summary_and_says_so(path, tmp_path, capsys):
    out = tmp_path / "out"
    assert needle_campaign(path, out, "--samples", "2") == 0
    shown = capsys.readouterr()
    assert "4 cases" in shown.out
    assert "of 4" in shown.err
    table = pd.read_parquet(out / "results")
    assert list(table["case"]) == [0, 1, 2, 3]
    for name in ("campaign.yaml", "summary.csv", "summary.png"):
        assert (out / name).is_file()
        assert name in shown.out.replace("\n", "")
    assert needle_campaign(path, out, "--samples", "3", "--resume") == 0
    assert "2 cases" in capsys.readouterr().out
    pd.testing.assert_frame_equal(pd.read_parquet(out / "results")[:4], table)


def test_failed_cases_are_shown_with_their_reason(tmp_path, capsys):
    path = tmp_path / "wide.yaml"
    path.write_text(yaml.safe_dump(content(vary={"free_mm": {"normal": [100.0, 1e5]}}, samples=6)))
    assert needle_campaign(path, tmp_path / "out") == 0
    shown = capsys.readouterr().out
    assert "failed: case" in shown
    assert "more failed cases: see the column" in shown


@pytest.mark.parametrize(
    ("changes", "more", "said"),
    [
        ({"seed": -1}, (), "Campaign.seed"),
        ({}, ("--samples", "0"), "Campaign.samples"),
        ({"vary": {"segments.0.trun_deg": {"normal": [1.0, 1.0]}}}, (), "turn_deg"),
        ({"base": "no-such.yaml"}, (), "no-such.yaml"),
    ],
)
def test_misuse_is_told_and_nothing_is_written(tmp_path, capsys, changes, more, said):
    path = tmp_path / "wrong.yaml"
    path.write_text(yaml.safe_dump(content(**changes)))
    assert needle_campaign(path, tmp_path / "out", *more) == 2
    assert said in capsys.readouterr().err.replace("\n", "")
    assert not (tmp_path / "out").exists()


def test_rigs_of_a_report_have_bands_of_their_tip_error(tmp_path, capsys):
    example = ROOT / "examples" / "tip-error.yaml"
    assert needle_campaign(example, tmp_path / "out", "--samples", "3") == 0
    shown = capsys.readouterr().out
    assert "Tip error" in shown
    table = pd.read_csv(tmp_path / "out" / "bands.csv")
    assert table["p50_deg"].iloc[-1] > 2.0  # dry friction holds the tip back for good
    assert abs(table["nominal_deg"].iloc[-1]) < 0.01


def test_the_example_is_a_campaign(tmp_path):
    example = ROOT / "examples" / "campaign.yaml"
    assert needle_campaign(example, tmp_path / "out", "--samples", "1") == 0
    assert len(pd.read_parquet(tmp_path / "out" / "results")) == 1


def in_this_folder(path, *more):
    return main(["campaign", str(path), "--workers", "1", *more])


def pieces(folder):
    return {p.name: p.stat().st_mtime_ns for p in (folder / "results").iterdir()}


def test_without_a_folder_each_run_gets_its_own(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    out = tmp_path / "out"
    name = yaml.safe_load(path.read_text())["name"]
    first, second = out / name, out / f"{name}-2"
    assert in_this_folder(path) == 0
    before = pieces(first)
    assert in_this_folder(path) == 0
    assert pieces(first) == before
    assert set(pieces(second)) == set(before)
    assert sorted(out.iterdir()) == [first, second]


def test_resume_without_a_folder_goes_on_where_the_campaign_was_begun_last(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name = yaml.safe_load(path.read_text())["name"]
    first, second = tmp_path / "out" / name, tmp_path / "out" / f"{name}-2"
    assert in_this_folder(path) == 0
    assert in_this_folder(path) == 0
    kept, lost = pieces(first), min((second / "results").iterdir())
    whole = lost.read_bytes()
    lost.unlink()
    path.write_text(yaml.safe_dump(content(seed=5)))
    assert in_this_folder(path) == 0  # another campaign of the same name has out/NAME-3
    path.write_text(yaml.safe_dump(content()))
    assert in_this_folder(path, "--resume") == 0
    assert lost.read_bytes() == whole
    assert pieces(first) == kept


def test_resume_refuses_a_folder_in_which_another_run_works(path, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert in_this_folder(path) == 0
    name = yaml.safe_load(path.read_text())["name"]
    with claiming(tmp_path / "out" / name):
        assert in_this_folder(path, "--resume") == 2
    assert "another run works in it" in capsys.readouterr().err.replace("\n", " ")
