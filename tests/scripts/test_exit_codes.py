"""Exit codes: one list, which the help, the docs and the signals follow."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from models.errors import NeedleError
from scripts import insert, validate
from scripts.exit_codes import ExitCode
from scripts.main import main
from scripts.stop_signals import EXIT_CODES
from sim.files import ResultSet
from studies.crosscheck.findings import Check, Findings

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "command-line.md"


def test_the_docs_list_every_code_in_the_same_words():
    rows = [
        line for line in PAGE.read_text().splitlines() if line.startswith("| `") and line[3].isdigit()
    ]
    assert rows == [f"| `{code.value}` | {code.words} |" for code in ExitCode]


def test_signals_give_the_codes_of_the_list():
    assert set(EXIT_CODES.values()) == {ExitCode.DONE, ExitCode.INTERRUPTED, ExitCode.TERMINATED}


@pytest.mark.parametrize(
    ("what", "code"),
    [(None, ExitCode.DONE), (NeedleError("x"), ExitCode.REFUSED), (KeyboardInterrupt(), 130)],
)
def test_a_command_exits_by_how_it_ended(what, code, monkeypatch, capsys):
    def listed(console):
        if what is not None:
            raise what
        return 0

    monkeypatch.setattr(insert, "list_protocols", listed)
    assert main(["protocols"]) == code


INTERRUPTED_IN_EXEC = """
import sys
from scripts import main
main._run = lambda *_: exec("raise KeyboardInterrupt")
sys.exit(main.main(["protocols"]))
"""


def test_an_interrupt_within_exec_exits_by_the_code_as_well(tmp_path):
    """Run with -m, CPython would end by the signal."""
    (tmp_path / "interrupted.py").write_text(INTERRUPTED_IN_EXEC)
    path = os.pathsep.join((str(tmp_path), str(ROOT)))
    command = [sys.executable, "-m", "interrupted"]
    path_too = {**os.environ, "PYTHONPATH": path}
    ended = subprocess.run(command, env=path_too, capture_output=True, check=False)
    assert ended.returncode == ExitCode.INTERRUPTED, ended.stderr


ENDED = """
import atexit
from scripts.exit_codes import end_process

class Slow:
    def __del__(self):
        print("taken apart")

kept = Slow()
kept.itself = kept
atexit.register(print, "registered")
print("written", end="; ")
end_process(3)
"""


def test_a_process_ends_with_what_was_registered_and_takes_nothing_apart():
    ended = subprocess.run(
        [sys.executable, "-c", ENDED], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (3, "written; registered\n", "")


@pytest.mark.parametrize(("measured", "code"), [(1.0, ExitCode.DONE), (2.0, ExitCode.BOUND_FAILS)])
def test_a_bound_that_fails_has_a_code_of_its_own(measured, code, monkeypatch, tmp_path, capsys):
    nothing = ResultSet(tmp_path, [], tmp_path)
    found = Findings(checks=[Check(name="x", value=measured, unit="-", high=1.5)])
    monkeypatch.setattr(validate, "checked", lambda destination: (found, nothing))
    assert main(["validate", "--out", str(tmp_path / "v")]) == code
