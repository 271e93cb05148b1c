"""A folder that is held is seen to be, until its holder ends, however it ends."""

import fcntl
import os
import signal
import subprocess
import sys

import pytest

from models.errors import UnwritableOutput
from sim.files import locks

HOLDER = """
import sys, time
from pathlib import Path
from sim.files.locks import left_alone
with left_alone(Path(sys.argv[1])) as ours:
    print(ours, flush=True)
    time.sleep(60)
"""


def test_a_lock_ends_with_the_process_that_holds_it(tmp_path):
    command = [sys.executable, "-c", HOLDER, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout.readline() == "True\n"
        with locks.left_alone(tmp_path) as alone:
            assert not alone
        holder.send_signal(signal.SIGKILL)
    with locks.left_alone(tmp_path) as alone:
        assert alone


def test_who_waits_too_long_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(locks, "_MOST_S", 0.0)
    told = pytest.raises(UnwritableOutput, match="another run has written here")
    with locks.holding(tmp_path), told, locks.holding(tmp_path):
        pass
    with locks.holding(tmp_path):
        pass


def test_without_locks_a_run_goes_on_and_takes_nobody_for_dead(tmp_path, monkeypatch):
    def none(*_):
        raise OSError(95, os.strerror(95))

    monkeypatch.setattr(fcntl, "flock", none)
    with locks.holding(tmp_path), locks.left_alone(tmp_path) as alone:
        assert not alone
