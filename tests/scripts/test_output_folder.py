"""Where results go: never over earlier ones, and decided before anything is computed."""

import io
from pathlib import Path

import pytest
from rich.console import Console

from models.errors import OutputExists
from scripts.output_folder import output_folder, say_written


def outputs(folder):
    return [folder / "a.json", folder / "b.png"]


@pytest.fixture
def default(tmp_path):
    return tmp_path / "out" / "control"


def with_results(*folders):
    for folder in folders:
        folder.mkdir(parents=True)
        (folder / "b.png").write_text("mine")


def test_the_default_is_the_first_numbered_folder_without_results(default):
    assert output_folder(None, default, outputs, force=False) == default
    with_results(default)
    assert output_folder(None, default, outputs, force=False) == default.with_name("control-2")
    with_results(default.with_name("control-2"))
    assert output_folder(None, default, outputs, force=False) == default.with_name("control-3")


def test_other_files_in_the_default_folder_are_no_results(default):
    default.mkdir(parents=True)
    (default / "notes.txt").write_text("mine")
    assert output_folder(None, default, outputs, force=False) == default


def test_a_folder_that_was_asked_for_is_refused_rather_than_numbered(default):
    with_results(default)
    with pytest.raises(OutputExists, match="--force"):
        output_folder(default, default, outputs, force=False)


def test_with_force_results_are_replaced_where_they_are(default):
    with_results(default)
    assert output_folder(None, default, outputs, force=True) == default
    assert output_folder(default, default, outputs, force=True) == default


def test_a_path_that_was_written_is_one_line_however_long_and_whatever_is_in_it():
    console = Console(file=io.StringIO(), width=20)
    path = Path("out") / "[red]a folder with blanks" / ("x" * 30)
    say_written(console, [path])
    assert console.file.getvalue() == f"wrote      {path}\n"
