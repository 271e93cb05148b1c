"""Results stay inside their folder, and replace nothing but results: not even with --force."""

import os

import pytest

from models.errors import OutputExists, UnsafeOutput, UnwritableOutput
from sim.files.destination import Destination


@pytest.fixture
def log(tmp_path):
    folder = tmp_path / "log"
    folder.mkdir()
    for name in ("rig.yaml", "trial_01.csv"):
        (folder / name).write_text("measured")
    return folder


def forced(folder, *inputs):
    return Destination(folder=folder, inputs=inputs, force=True)


def test_existing_results_are_named_before_any_work_unless_forced(tmp_path):
    there, missing = tmp_path / "there.csv", tmp_path / "missing.csv"
    there.write_text("mine")
    with pytest.raises(OutputExists, match=r"there\.csv exists.*--force"):
        Destination(folder=tmp_path).check([missing, there])
    Destination(folder=tmp_path).check([missing])
    forced(tmp_path).check([missing, there])


def test_force_replaces_no_input_under_whatever_name(tmp_path, log):
    """As itself, by way of `..`, and as a second name of the same file."""
    measured, other = log / "trial_01.csv", tmp_path / "out" / "trial_01.csv"
    other.parent.mkdir()
    os.link(measured, other)
    around = tmp_path / "out" / ".." / "log"
    for folder in (log, around, other.parent):
        with pytest.raises(UnsafeOutput, match="which this run reads"):
            forced(folder, measured).check([folder / measured.name])
    forced(log, log / "rig.yaml").check([measured])  # the negative control: it is not read


@pytest.mark.parametrize("linked", ["predictions", "predictions/trial_01.csv"])
def test_results_go_through_no_link_inside_their_folder(tmp_path, log, linked):
    out = tmp_path / "out"
    (out / linked).parent.mkdir(parents=True)
    (out / linked).symlink_to(log if linked == "predictions" else log / "trial_01.csv")
    with pytest.raises(UnsafeOutput, match="a link"):
        forced(out).check([out / "predictions" / "trial_01.csv"])


def test_the_folder_itself_may_be_a_link(tmp_path, log):
    out = tmp_path / "out"
    out.symlink_to(log)
    forced(out).check([out / "report.json"])


@pytest.mark.parametrize("name", ["../up.csv", "a/../../up.csv", "."])
def test_results_stay_inside_their_folder(tmp_path, name):
    with pytest.raises(UnsafeOutput, match="outside of"):
        forced(tmp_path / "out").check([tmp_path / "out" / name])


def test_two_results_have_two_paths(tmp_path):
    with pytest.raises(UnsafeOutput, match="two results"):
        forced(tmp_path).check([tmp_path / "fig4.csv", tmp_path / "fig4.csv"])


def test_what_is_no_file_is_not_replaced(tmp_path):
    (tmp_path / "report.json").mkdir()
    with pytest.raises(UnsafeOutput, match="not a file"):
        forced(tmp_path).check([tmp_path / "report.json"])


@pytest.mark.parametrize(
    ("folder", "said"),
    [
        ("file", "is a file, but a folder is needed"),
        ("file/below", "Not a directory; give a folder, not a file"),
        ("dangling", "is a link to something that does not exist"),
        ("dangling/below", "is a link to something that does not exist"),
        ("n" * 300, "File name too long; give a shorter name"),
        ("new/" + "n" * 300, "a name of more than 255 bytes"),
        ("nul\0", "cannot hold the character NUL"),
    ],
)
def test_a_place_where_nothing_can_be_written_is_named(tmp_path, folder, said):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "dangling").symlink_to(tmp_path / "nowhere")
    place = tmp_path / folder
    with pytest.raises(UnwritableOutput, match=said):
        forced(place).check([place / "report.json"])
    assert sorted(p.name for p in tmp_path.iterdir()) == ["dangling", "file"]


@pytest.mark.parametrize("name", ["n" * 300, "nul\0"])
def test_a_name_that_no_file_can_have_is_refused_before_its_folder_exists(tmp_path, name):
    with pytest.raises(UnwritableOutput):
        forced(tmp_path / "new").check([tmp_path / "new" / name])


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write everywhere")
@pytest.mark.parametrize("closed", ["out", "out/predictions"])
def test_a_folder_without_permission_is_named(tmp_path, closed):
    (tmp_path / "out" / "predictions").mkdir(parents=True)
    (tmp_path / closed).chmod(0o500)
    with pytest.raises(UnwritableOutput, match="you may not write here"):
        forced(tmp_path / "out").check([tmp_path / "out" / "predictions" / "trial_01.csv"])


def test_a_folder_without_permission_is_named_to_the_superuser_too(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(UnwritableOutput, match="you may not write here"):
        forced(tmp_path).check([tmp_path / "report.json"])
