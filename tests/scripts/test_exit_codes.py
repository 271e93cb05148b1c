"""Exit codes: one list, which the help, the docs and the signals follow."""

from pathlib import Path

import pytest

from models.errors import NeedleError
from scripts import insert, validate
from scripts.exit_codes import ExitCode
from scripts.main import main
from scripts.stop_signals import EXIT_CODES
from sim.files import ResultSet
from studies.crosscheck.findings import Check, Findings

PAGE = Path(__file__).parents[2] / "docs" / "command-line.md"


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


@pytest.mark.parametrize(("measured", "code"), [(1.0, ExitCode.DONE), (2.0, ExitCode.BOUND_FAILS)])
def test_a_bound_that_fails_has_a_code_of_its_own(measured, code, monkeypatch, tmp_path, capsys):
    nothing = ResultSet(tmp_path, [], tmp_path)
    found = Findings(checks=[Check(name="x", value=measured, unit="-", high=1.5)])
    monkeypatch.setattr(validate, "checked", lambda destination: (found, nothing))
    assert main(["validate", "--out", str(tmp_path / "v")]) == code
