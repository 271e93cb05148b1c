"""`needle diagnose` that is stopped: by a limit, by signals, by an end that nobody can hear of."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from analytic_log import write_log

from scripts.main import main

ROOT = Path(__file__).parents[2]
PROCESSES = Path("/proc")
PATIENCE_S = 120.0  # for a busy machine
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not PROCESSES.is_dir(), reason="children are found in /proc"),
]


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A needle that the library does not explain: its search is long."""
    return write_log(tmp_path_factory.mktemp("stopped") / "log")


def state_and_parent(pid):
    """Of a process: its letter in /proc, and the process that made it; None: it is gone."""
    try:
        fields = (PROCESSES / str(pid) / "stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return fields[0], int(fields[1])


def alive(pid):
    found = state_and_parent(pid)
    return found is not None and found[0] != "Z"


def workers_of(pid):
    """Its children that run what it runs: not the compilers and so on that imports may ask."""
    everybody = [int(path.name) for path in PROCESSES.glob("[0-9]*")]
    own = [p for p in everybody if (found := state_and_parent(p)) and found[1] == pid]
    return [p for p in own if command_of(p) == command_of(pid)]


def command_of(pid):
    try:
        return (PROCESSES / str(pid) / "cmdline").read_bytes()
    except OSError:
        return None


def until(condition, within_s=PATIENCE_S):
    """Waits for a condition; whether it came."""
    ends_s = time.monotonic() + within_s
    while not condition():
        if time.monotonic() > ends_s:
            return False
        time.sleep(0.02)
    return True


@pytest.fixture
def diagnosing(log):
    """Starts the command in a group of its own; back once its workers are there."""
    started = []

    def start(*arguments):
        command = [sys.executable, "-m", "scripts.main", "diagnose", str(log), *map(str, arguments)]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        process = subprocess.Popen(command, cwd=ROOT, start_new_session=True, **pipes)
        started.append(process)
        assert until(lambda: len(workers_of(process.pid)) == 2 or process.poll() is not None)
        return process, workers_of(process.pid)

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.mark.parametrize(
    ("number", "why"), [(signal.SIGINT, "interrupted"), (signal.SIGTERM, "terminated")]
)
def test_a_signal_to_the_group_gives_the_best_so_far(diagnosing, number, why):
    process, workers = diagnosing("--json")
    os.killpg(process.pid, number)
    printed, said = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 128 + number, said
    report = json.loads(printed)
    assert report["stopped"]["why"] == why
    assert report["verdict"] in ("undecided", "unknown")
    assert not any(alive(pid) for pid in workers)


def test_interrupted_twice_nothing_is_written(diagnosing, tmp_path):
    process, workers = diagnosing("--out", tmp_path / "out")
    os.killpg(process.pid, signal.SIGINT)
    time.sleep(0.2)  # two that come at once are one
    os.killpg(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130, said
    assert "no incomplete file is left" in said
    assert not list(tmp_path.rglob("*.*"))
    assert not any(alive(pid) for pid in workers)


def test_workers_end_within_a_second_of_a_parent_that_is_killed(diagnosing):
    process, workers = diagnosing("--json")
    assert len(workers) == 2
    process.kill()
    assert until(lambda: not any(alive(pid) for pid in workers), within_s=1.0)


def test_after_a_limit_every_file_is_there_and_says_so(log, tmp_path, capsys):
    """In this process, whose Python has started already, so that a busy machine is in time, too."""
    assert main(["diagnose", str(log), "--out", str(tmp_path / "out"), "--limit", "10"]) == 0
    assert capsys.readouterr().out.startswith("Stopped early (limit of 10 s, while")
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["stopped"]["why"] == "limit of 10 s"
    assert report["verdict"] in ("undecided", "unknown")
    assert "Stopped early (limit of 10 s" in (tmp_path / "out" / "report.html").read_text()
    assert (tmp_path / "out" / "gap.rrd").stat().st_size > 0


def test_a_limit_that_is_too_short_for_anything_is_an_error(log, capsys):
    assert main(["diagnose", str(log), "--limit", "0.01"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "limit of 0.01 s: stopped before the nominal rig was replayed" in said
