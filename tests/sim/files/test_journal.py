"""A run may be killed at any moment: the next one finds the old set, or finishes the new one."""

import os
import signal

import pytest

from models.errors import UnsafeOutput
from sim.files import Destination, journal, publishing

NAMES = ("a.csv", "b.csv", "sub/c.csv", "d.png")


def texts(folder):
    """Results and nothing that a run keeps to itself."""
    files = [p.relative_to(folder) for p in folder.rglob("*") if p.is_file()]
    return {str(p): (folder / p).read_text() for p in files if not p.parts[0].startswith(journal.PREFIX)}


OLD, NEW = dict.fromkeys(NAMES, "old"), dict.fromkeys(NAMES[:3], "new")


def old_set(folder):
    paths = [folder / name for name in NAMES]
    with publishing(Destination(folder=folder, force=True), paths) as results:
        for path in paths:
            results.at(path).write_text("old")


def killed_at(folder, last):
    """A run in a process of its own, that is killed at its last-th call to the system.

    Returns how it ended. Its d.png fails.
    """
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    calls = iter(range(1, 10_000))

    def counted(call):
        def counting(*given, **how):
            if next(calls) == last:
                os.kill(os.getpid(), signal.SIGKILL)
            return call(*given, **how)

        return counting

    try:
        for name in ("mkdir", "replace", "unlink", "rmdir", "fsync"):
            setattr(os, name, counted(getattr(os, name)))
        paths = [folder / name for name in NAMES]
        with publishing(Destination(folder=folder, force=True), paths) as results:
            for path in paths[:3]:
                results.at(path).write_text("new")
            results.optional(paths[3], lambda part: part.no_such_thing)
        os._exit(0)
    finally:
        os._exit(1)


def test_killed_at_each_step_the_next_reader_finds_the_old_set_or_the_new_one(tmp_path):
    """Each step in turn, until one run comes to its end."""
    found, between = [], 0
    for last in range(1, 100):
        folder = tmp_path / str(last)
        old_set(folder)
        ended = killed_at(folder, last)
        between += texts(folder) not in (OLD, NEW)
        journal.finish_interrupted(folder)
        found.append(texts(folder))
        assert found[-1] in (OLD, NEW), last
        assert not list(folder.glob(".needle-*"))
        if ended == 0:
            break
        assert ended == -signal.SIGKILL
    assert (found[0], found[-1]) == (OLD, NEW)
    assert found.count(OLD) > 3
    assert found.count(NEW) > 3
    assert between  # else the journal would not be needed


def dead_run(folder, place=(), remove=()):
    part = folder / f"{journal.PREFIX}abcd_123"
    (part / journal.RESULTS).mkdir(parents=True)
    for name in place:
        (part / journal.RESULTS / name).write_text("new")
    if place or remove:
        journal.decide(part, journal.Journal(place=place, remove=remove))
    return part


def test_what_a_dead_run_had_only_begun_is_cleared_away_by_the_next(tmp_path):
    part = dead_run(tmp_path)
    (part / journal.RESULTS / "a.csv").write_text("half")
    journal.finish_interrupted(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_what_a_dead_run_had_decided_is_finished_by_the_next(tmp_path):
    (tmp_path / "d.png").write_text("old")
    dead_run(tmp_path, place=("a.csv",), remove=("d.png",))
    with publishing(Destination(folder=tmp_path), [tmp_path / "other.csv"]) as results:
        results.at(tmp_path / "other.csv").write_text("own")
    assert texts(tmp_path) == {"a.csv": "new", "other.csv": "own"}


@pytest.mark.parametrize("name", ["../up.csv", "/up.csv"])
def test_a_journal_leads_out_of_no_folder(tmp_path, name):
    """It may have come with a folder from elsewhere."""
    folder = tmp_path / "out"
    folder.mkdir()
    (tmp_path / "up.csv").write_text("mine")
    part = dead_run(folder)
    journal.decide(part, journal.Journal(place=(), remove=(name,)))
    with pytest.raises(UnsafeOutput):
        journal.finish_interrupted(folder)
    assert (tmp_path / "up.csv").read_text() == "mine"


def test_what_is_no_journal_decides_nothing(tmp_path):
    part = dead_run(tmp_path)
    (part / "journal.json").write_text('{"place": 1}')
    assert journal.decided(part) is None
    assert journal.decided(tmp_path / "nowhere") is None


@pytest.mark.parametrize("name", [".needle-part-my-notes", ".needle-part-abc", "needle-part-abcd_123"])
def test_folders_of_the_user_are_left_alone(tmp_path, name):
    (tmp_path / name).mkdir()
    (tmp_path / name / "mine").write_text("mine")
    journal.finish_interrupted(tmp_path)
    with publishing(Destination(folder=tmp_path), [tmp_path / "a.csv"]) as results:
        results.at(tmp_path / "a.csv").write_text("new")
    assert (tmp_path / name / "mine").read_text() == "mine"
    assert not journal.is_of_a_run(name)


def test_runs_of_other_users_are_left_alone(tmp_path, monkeypatch):
    part = dead_run(tmp_path, place=("a.csv",))
    monkeypatch.setattr(os, "getuid", lambda: part.stat().st_uid + 1)
    journal.finish_interrupted(tmp_path)
    assert part.exists()
    assert not (tmp_path / "a.csv").exists()


def test_what_is_on_the_disk_can_be_asked_of_files_and_folders(tmp_path):
    (tmp_path / "a").write_text("a")
    journal.on_disk(tmp_path / "a")
    journal.on_disk(tmp_path)
    with pytest.raises(FileNotFoundError):
        journal.on_disk(tmp_path / "b")
