"""A set of results is all new or all old."""

import errno
import os
import shutil
import subprocess
from multiprocessing import get_context

import pytest

from models.errors import OutputExists, UnsafeOutput, UnwritableOutput
from sim.files import journal
from sim.files.destination import Destination
from sim.files.publish import publishing

NAMES = ("report.json", "report.html", "predictions/trial_01.csv")


def paths_in(folder):
    return [folder / name for name in NAMES]


def being_made(folder, *, force=True):
    return publishing(Destination(folder=folder, force=force), paths_in(folder))


def publish(folder, text, *, force=True):
    with being_made(folder, force=force) as results:
        for path in paths_in(folder):
            results.at(path).write_text(text)
    return results


def texts(folder):
    return {str(p.relative_to(folder)): p.read_text() for p in folder.rglob("*") if p.is_file()}


def test_all_files_get_their_names_at_the_end_and_nothing_else_is_left(tmp_path):
    folder = tmp_path / "out"
    results = publish(folder, "new", force=False)
    assert texts(folder) == dict.fromkeys(NAMES, "new")
    assert sorted(p.name for p in folder.iterdir()) == ["predictions", "report.html", "report.json"]
    assert results.made == paths_in(folder)


@pytest.mark.parametrize("failure", [KeyboardInterrupt, ValueError, OSError(errno.ENOSPC, "full")])
def test_what_fails_half_way_leaves_the_old_set(tmp_path, failure):
    publish(tmp_path, "old")
    failing = pytest.raises((KeyboardInterrupt, ValueError, UnwritableOutput))
    with failing, being_made(tmp_path) as results:
        results.at(tmp_path / NAMES[0]).write_text("new")
        raise failure
    assert texts(tmp_path) == dict.fromkeys(NAMES, "old")


def test_a_disk_that_is_full_when_it_is_asked_leaves_no_file(tmp_path, monkeypatch):
    """Some systems tell only when the file has to be on the disk."""

    def full(_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(UnwritableOutput, match="No space left on device; free some space"):
        publish(tmp_path, "new")
    assert list(tmp_path.iterdir()) == []


def test_a_picture_that_fails_takes_its_old_one_along_and_nothing_else(tmp_path):
    publish(tmp_path, "old")
    with being_made(tmp_path) as results:
        told, shown, prediction = paths_in(tmp_path)
        results.at(told).write_text("new")
        results.at(prediction).write_text("new")

        def fails(part):
            part.write_text("half")
            raise ValueError("mathtext")

        results.optional(shown, fails)
    assert texts(tmp_path) == {NAMES[0]: "new", NAMES[2]: "new"}
    assert results.left_out == {shown: "ValueError: mathtext"}
    assert results.made == [told, prediction]


def test_a_picture_for_which_the_disk_is_too_full_fails_the_set(tmp_path):
    def full(part):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(part))

    told = pytest.raises(UnwritableOutput, match="free some space")
    with told, being_made(tmp_path) as results:
        results.optional(tmp_path / NAMES[1], full)
    assert list(tmp_path.iterdir()) == []


def test_what_appears_meanwhile_is_not_overwritten(tmp_path):
    with pytest.raises(OutputExists), being_made(tmp_path, force=False) as results:
        for path in paths_in(tmp_path):
            results.at(path).write_text("new")
        (tmp_path / NAMES[1]).write_text("mine")
    assert texts(tmp_path) == {NAMES[1]: "mine"}


def test_a_link_that_appears_meanwhile_is_not_followed(tmp_path):
    mine, folder = tmp_path / "mine", tmp_path / "out"
    mine.mkdir()
    with pytest.raises(UnsafeOutput), being_made(folder) as results:
        for path in paths_in(folder):
            results.at(path).write_text("new")
        (folder / "predictions").symlink_to(mine)
    assert list(mine.iterdir()) == []


def test_a_whole_folder_is_a_result(tmp_path):
    folder = tmp_path / "set"
    with publishing(Destination(folder=tmp_path), [folder]) as results:
        (results.at(folder) / "logs").mkdir(parents=True)
        (results.at(folder) / "logs" / "rig.yaml").write_text("new")
    assert texts(tmp_path) == {"set/logs/rig.yaml": "new"}


def test_two_runs_in_one_folder_leave_the_set_of_one(tmp_path):
    """The second clears away nothing of the first, which lives."""
    with being_made(tmp_path) as first:
        for path in paths_in(tmp_path):
            first.at(path).write_text("first")
        publish(tmp_path, "second")
        assert texts(tmp_path).items() >= dict.fromkeys(NAMES, "second").items()
    assert texts(tmp_path) == dict.fromkeys(NAMES, "first")


def published(folder, text, force, together, told):
    """In a process that gives its files their names when all others do."""
    try:
        with being_made(folder, force=force) as results:
            for path in paths_in(folder):
                results.at(path).write_text(text)
            together.wait()
        told.put((text, "done"))
    except OutputExists:
        told.put((text, "exists"))


@pytest.mark.parametrize(("force", "done"), [(True, 4), (False, 1)])
def test_processes_in_one_folder_leave_the_set_of_one(tmp_path, force, done):
    fork = get_context("fork")
    together, told = fork.Barrier(4, timeout=60), fork.Queue()
    each = [
        fork.Process(target=published, args=(tmp_path, text, force, together, told)) for text in "abcd"
    ]
    for process in each:
        process.start()
    ends = dict(told.get(timeout=60) for _ in each)
    for process in each:
        process.join()
    assert list(ends.values()).count("done") == done
    (winner,) = set(texts(tmp_path).values())
    assert texts(tmp_path) == dict.fromkeys(NAMES, winner)
    assert ends[winner] == "done"


def test_ctrl_c_while_files_get_their_names_waits_for_the_rest(tmp_path, monkeypatch):
    publish(tmp_path, "old")
    rename, calls = journal.Path.replace, []

    def interrupted(self, target):
        calls.append(target)
        if target.name == "report.html" and calls.count(target) == 1:
            raise KeyboardInterrupt
        return rename(self, target)

    monkeypatch.setattr(journal.Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        publish(tmp_path, "new")
    assert texts(tmp_path) == dict.fromkeys(NAMES, "new")


@pytest.fixture
def small_disk(tmp_path):
    """A disk of 64 kB, where this machine lets us mount one."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(place)]
    if not shutil.which("mount") or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("mounting a small disk needs the superuser")
    yield place
    subprocess.run(["umount", str(place)], check=True)


def test_a_disk_that_is_full_is_an_error_and_leaves_the_old_set(small_disk):
    publish(small_disk, "old")
    with pytest.raises(UnwritableOutput, match=r"No space left on device; free some space"):
        publish(small_disk, "new" * 20_000)
    assert texts(small_disk) == dict.fromkeys(NAMES, "old")
