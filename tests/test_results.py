"""Results of commands: never over what a command reads, and told as they are."""

import io
import os
import shutil
from pathlib import Path

import pytest
import yaml
from analytic_log import write_log
from lab_files import mapping_of, write_csv
from rich.console import Console

from scripts.exit_codes import ExitCode
from scripts.main import main
from scripts.results import tell
from scripts.terminal import Terminal
from sim.files import Destination, ResultSet, publishing

EXAMPLE = Path(__file__).parent.parent / "examples"


@pytest.fixture
def log(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return write_log(tmp_path / "log")


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def refused(arguments, capsys, *said):
    """The command is refused with these words, and no file has changed."""
    before = contents(Path.cwd())
    assert main([*map(str, arguments), "--force"]) == 2
    told = " ".join(capsys.readouterr().err.split())
    assert all(words in told for words in said), told
    assert contents(Path.cwd()) == before


@pytest.mark.parametrize("command", ["replay", "diagnose"])
def test_no_measurement_is_written_over_by_its_prediction(log, capsys, command):
    shutil.move(log, "predictions")
    refused([command, "predictions", "--out", "."], capsys, "turns.csv", "which this run reads")


@pytest.mark.parametrize("command", ["replay", "diagnose"])
def test_no_measurement_is_written_over_through_a_link(log, capsys, command):
    Path("o").mkdir()
    Path("o/predictions").symlink_to(log)
    refused([command, log, "--out", "o"], capsys, "o/predictions: is a link")


def test_no_measurement_is_written_over_by_its_second_name(log, capsys):
    Path("o/predictions").mkdir(parents=True)
    os.link(log / "turns.csv", "o/predictions/turns.csv")
    refused(["replay", log, "--out", "o"], capsys, "o/predictions/turns.csv", "which this run reads")


@pytest.fixture
def protocol(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return shutil.copy(EXAMPLE / "protocol.yaml", tmp_path / "p.yaml")


def test_no_model_is_written_over_the_protocol_that_is_read(protocol, capsys):
    for folder in ("o", "."):
        command = ["insert", "--protocol", "p.yaml", "--out", folder, "--mjcf", "p.yaml"]
        refused(command, capsys, "p.yaml", "which this run reads")


def test_no_model_is_written_through_a_link(protocol, capsys):
    Path("m.xml").symlink_to(protocol)
    refused(
        ["insert", "--protocol", "p.yaml", "--out", "o", "--mjcf", "m.xml"], capsys, "m.xml: is a link"
    )


def test_no_recording_is_written_over_a_protocol_that_is_named_like_it(protocol, capsys):
    content = yaml.safe_load(protocol.read_text())
    Path("o").mkdir()
    Path("o/two-layers.csv").write_text("mine")
    os.link("o/two-layers.csv", "model.xml")
    assert content["name"] == "two-layers"
    command = ["insert", "--protocol", "p.yaml", "--out", "o", "--model", "model.xml"]
    refused(command, capsys, "o/two-layers.csv", "which this run reads")


def test_no_lab_file_and_no_mapping_is_written_over(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    file = write_csv(tmp_path)
    os.link(file, "trial_00.csv")
    Path("mapping.yaml").write_text(yaml.safe_dump(mapping_of(["run.csv"])))
    command = ["import", file, "--map", "mapping.yaml", "--out", "."]
    refused(command, capsys, "trial_00.csv", "which this run reads")
    os.link(file, "preview.png")
    refused(["import", file, "--out", "."], capsys, "preview.png", "which this run reads")


def test_no_ground_truth_is_written_over(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for folder in ("logs", "answers"):
        (tmp_path / folder).mkdir()
    Path("answers/answers.json").write_text("{}")
    os.link("answers/answers.json", "scores.csv")
    refused(["blind", "score", ".", "--out", "."], capsys, "scores.csv", "which this run reads")


def test_results_replace_no_folder_and_no_file_on_the_way(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("o/validate.json").mkdir(parents=True)
    refused(["validate", "--out", "o"], capsys, "o/validate.json: is not a file")
    Path("file").write_text("mine")
    for out in ("file", "file/below"):
        refused(["control", "--out", out], capsys, "give", "folder")


def test_a_picture_that_fails_is_told_with_its_own_exit_code(tmp_path, capsys):
    paths = [tmp_path / "a [/] with blanks.csv", tmp_path / "b.png"]
    with publishing(Destination(folder=tmp_path), paths) as results:
        results.at(paths[0]).write_text("whole")
        results.optional(paths[1], lambda part: {}["title"])
    console = Terminal(width=20, file=io.StringIO(), markup=False)
    assert tell(results, console) == ExitCode.WITHOUT_ALL == 3
    assert console.file.getvalue() == f"wrote      {paths[0]}\n"
    said = " ".join(capsys.readouterr().err.split())
    assert "b.png could not be made (KeyError: 'title')" in said


def test_a_page_that_lacks_a_picture_is_told_with_the_same_exit_code(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "500")  # however long the path is
    page = tmp_path / "report.html"
    with publishing(Destination(folder=tmp_path), [page]) as results:
        results.at(page).write_text("whole but for a picture")
        results.lacks[page] = ("the picture under 'Loops' (ValueError: mathtext)",)
    console = Console(file=io.StringIO(), width=200)
    assert tell(results, console) == ExitCode.WITHOUT_ALL
    assert console.file.getvalue() == f"wrote      {page}\n"
    said = " ".join(capsys.readouterr().err.split())
    assert "report.html lacks the picture under 'Loops' (ValueError: mathtext); the rest" in said


def test_many_results_are_told_in_other_words(tmp_path):
    paths = [tmp_path / f"{i}.csv" for i in range(3)]
    console = Terminal(width=20, file=io.StringIO(), markup=False)
    code = tell(ResultSet(tmp_path, paths, tmp_path), console, shown=["three tables", paths[0]])
    assert code == ExitCode.DONE
    assert console.file.getvalue() == f"wrote      three tables\nwrote      {paths[0]}\n"


def test_all_results_are_told_with_exit_code_0(tmp_path, capsys):
    with publishing(Destination(folder=tmp_path), [tmp_path / "a.csv"]) as results:
        results.at(tmp_path / "a.csv").write_text("whole")
    assert tell(results, Console(file=io.StringIO())) == 0
    assert capsys.readouterr().err == ""


def test_a_failing_picture_leaves_an_insertion(tmp_path, monkeypatch, capsys):
    from scripts import insert

    def fails(*_):
        raise ValueError("mathtext")

    monkeypatch.setattr(insert, "draw", fails)
    assert main(["insert", "--protocol", "fig5-5cm", "--out", str(tmp_path)]) == 3
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".csv", ".parquet", ".rrd"]
    assert "mathtext" in capsys.readouterr().err
