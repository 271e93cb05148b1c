"""A place is one run's at a time, and nothing is left of the claim."""

import os
import signal
import subprocess
import sys

import pytest

from models.errors import UnwritableOutput
from sim.files.claim import PREFIX, claiming

HOLDER = """
import sys, time
from pathlib import Path
from sim.files.claim import claiming
with claiming(Path(sys.argv[1])) as ours:
    print(ours, flush=True)
    time.sleep(60)
"""


def test_a_place_is_claimed_once_and_nothing_is_left_in_the_end(tmp_path):
    place = tmp_path / "out" / "insert"
    with claiming(place) as first, claiming(place) as second, claiming(place) as third:
        assert (first, second, third) == (True, False, False)
        assert [path.name for path in place.parent.iterdir()] == [f"{PREFIX}insert"]
    assert list(tmp_path.iterdir()) == []
    with claiming(place) as again:
        assert again


def test_places_beside_each_other_are_claimed_apart_and_keep_what_is_there(tmp_path):
    with claiming(tmp_path / "out" / "a") as first, claiming(tmp_path / "out" / "b") as second:
        (tmp_path / "out" / "b").mkdir()
    assert first
    assert second
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["b"]


def test_the_claim_of_a_process_that_was_killed_is_nobodys(tmp_path):
    place = tmp_path / "insert"
    command = [sys.executable, "-c", HOLDER, str(place)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout.readline() == "True\n"
        with claiming(place) as ours:
            assert not ours
        holder.send_signal(signal.SIGKILL)
    assert (tmp_path / f"{PREFIX}insert").exists()
    with claiming(place) as ours:
        assert ours
    assert list(tmp_path.iterdir()) == []


def test_a_claim_whose_file_its_former_owner_removes_is_not_taken(tmp_path, monkeypatch):
    """Between opening the file and locking it."""
    claim = tmp_path / f"{PREFIX}insert"
    opened = os.open

    def removed_at_once(path, *how):
        handle = opened(path, *how)
        claim.unlink(missing_ok=True)
        return handle

    monkeypatch.setattr(os, "open", removed_at_once)
    with claiming(tmp_path / "insert") as ours:
        assert not ours


def test_no_claim_goes_through_a_link(tmp_path):
    (tmp_path / f"{PREFIX}insert").symlink_to(tmp_path / "mine")
    with pytest.raises(UnwritableOutput), claiming(tmp_path / "insert"):
        pass
    assert not (tmp_path / "mine").exists()
