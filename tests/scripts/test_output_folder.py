"""Where results go: never over earlier ones, and decided before anything is computed."""

import os
import subprocess
import sys
from multiprocessing import get_context
from pathlib import Path

import pytest
import yaml

from models.errors import OutputExists, UnsafeOutput
from scripts import output_folder as module
from sim.files import Destination
from sim.recording.recording import read


@pytest.fixture(autouse=True)
def _released():
    yield
    module.release_folders()


def outputs(folder):
    return [folder / "a.json", folder / "b.png"]


@pytest.fixture
def default(tmp_path):
    return tmp_path / "out" / "control"


def output_folder(*given, force):
    return module.output_folder(*given, force=force).folder


def with_results(*folders):
    for folder in folders:
        folder.mkdir(parents=True)
        (folder / "b.png").write_text("mine")


def test_the_default_is_the_first_numbered_folder_without_results(default):
    assert output_folder(None, default, outputs, force=False) == default
    module.release_folders()
    with_results(default)
    assert output_folder(None, default, outputs, force=False) == default.with_name("control-2")
    module.release_folders()
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


def test_a_default_folder_that_a_dead_run_had_decided_has_results(default, monkeypatch):
    """They get their names before the folder is looked at."""
    monkeypatch.setattr(
        module, "finish_interrupted", lambda folder: folder.exists() or with_results(folder)
    )
    (default.with_name("control-2")).mkdir(parents=True)
    assert output_folder(None, default, outputs, force=False) == default.with_name("control-2")


def test_no_input_is_written_over_and_the_choice_says_so_before_any_work(default):
    with_results(default)
    how = {"inputs": [default / "b.png"], "force": True}
    with pytest.raises(UnsafeOutput, match="which this run reads"):
        module.output_folder(None, default, outputs, **how)
    found = module.output_folder(None, default.with_name("other"), outputs, **how)
    assert found == Destination(
        folder=default.with_name("other"), inputs=(default / "b.png",), force=True
    )


def test_what_was_chosen_is_nobody_elses_until_the_run_is_done(default):
    assert output_folder(None, default, outputs, force=False) == default
    assert output_folder(None, default, outputs, force=False) == default.with_name("control-2")
    module.release_folders()
    assert not default.parent.exists()
    assert output_folder(None, default, outputs, force=False) == default


def chosen(default, together, told):
    """Of a process that works until all have chosen."""
    together.wait()
    found = output_folder(None, default, outputs, force=False)
    together.wait()
    told.put(found.name)
    module.release_folders()


def test_processes_that_choose_at_once_get_folders_of_their_own(default):
    default.parent.mkdir()
    fork = get_context("fork")
    together, told = fork.Barrier(4, timeout=60), fork.Queue()
    each = [fork.Process(target=chosen, args=(default, together, told)) for _ in range(4)]
    for process in each:
        process.start()
    found = {told.get(timeout=60) for _ in each}
    for process in each:
        process.join()
    assert found == {"control", "control-2", "control-3", "control-4"}
    assert list(default.parent.iterdir()) == []


TURNS_DEG = (30.0, 60.0)


def begun(folder, turn_deg):
    """`needle insert` as a process of its own, whose files are named alike whatever its turn."""
    protocol = {
        "name": "short",
        "tissue": "soft-plastisol",
        "free_mm": 50.0,
        "inserted_mm": 100.0,
        "discretisation": {"elements": 8},
        "segments": [{"duration_s": 0.2, "turn_deg": turn_deg}],
    }
    path = folder / f"turn-{turn_deg:g}.yaml"
    path.write_text(yaml.safe_dump(protocol))
    root = str(Path(__file__).parents[2])
    return subprocess.Popen(
        [sys.executable, "-m", "scripts.main", "insert", "--protocol", path.name],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": root, "PYTHONSAFEPATH": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def turned(path):
    """Whose recording it is: the turn that is nearest to that of its base."""
    end_deg = read(path)["base_angle_deg"][-1]
    return min(TURNS_DEG, key=lambda turn_deg: abs(turn_deg - end_deg))


@pytest.mark.slow
def test_two_commands_at_once_in_one_folder_have_results_of_their_own(tmp_path):
    both = [begun(tmp_path, turn_deg) for turn_deg in TURNS_DEG]
    told = [process.communicate(timeout=120)[0] for process in both]
    assert [process.returncode for process in both] == [0, 0], told
    folders = sorted((tmp_path / "out").iterdir())
    assert [folder.name for folder in folders] == ["insert", "insert-2"]
    names = [{path.name for path in folder.iterdir()} for folder in folders]
    assert names[0] == names[1] == {f"short{end}" for end in (".csv", ".parquet", ".png", ".rrd")}
    turns = [[turned(folder / f"short{end}") for end in (".csv", ".parquet")] for folder in folders]
    assert sorted(turns) == [[turn_deg, turn_deg] for turn_deg in TURNS_DEG]
