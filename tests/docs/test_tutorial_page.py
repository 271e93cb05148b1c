"""The commands and the Python of docs/tutorial.md run as written; the diagnosis is cut short."""

import re
import shlex
from pathlib import Path

import pytest

from scripts.arguments import parser
from scripts.main import main

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "tutorial.md").read_text()
COMMANDS = re.findall(r"```sh\n(.*?)```", PAGE, flags=re.DOTALL)


def split(command):
    """Arguments of a command, and the exit code that its comment says."""
    written, _, comment = command.partition("#")
    return shlex.split(written)[1:], 2 if "exit code 2" in comment else 0


def test_the_tutorial_goes_from_files_to_a_diagnosis():
    names = [parser().parse_args(split(c)[0]).command for c in COMMANDS]
    assert names == ["import", "import", "import", "replay", "diagnose"]


@pytest.mark.slow
@pytest.mark.usefixtures("out_of_time_after_the_nominal_replay")
def test_every_command_runs_one_after_the_other(tmp_path, monkeypatch):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    for command in COMMANDS:
        arguments, code = split(command.replace("--limit 60", "--limit 600"))
        assert main(arguments) == code, command
    for made in ("mapping.yaml", "preview.png", "log/rig.yaml", "gap/report.html"):
        assert (tmp_path / "out" / "tutorial" / made).is_file()


def test_the_needle_with_what_was_found_holds_its_lag():
    """Dry friction on a shaft with 50 mm free: (2) of the lag that 0.0014 N mm / mm can hold."""
    names = {}
    exec(PAGE.split("```python\n")[1].split("```")[0], names)
    assert 0.5 < names["lag_deg"][-1] < 3.0
