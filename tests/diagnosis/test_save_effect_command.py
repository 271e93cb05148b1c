"""`needle diagnose --save-effect`: what is saved, and what is said where nothing is."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from saved_laws import STICKY, missing_with

from diagnosis.effects.saved.effect_file import read_effect
from diagnosis.effects.saved.folder import OWN_FOLDER
from diagnosis.replay.rig_parameters import NOMINAL
from scripts import diagnose as command
from scripts.main import main

LOG = "examples/rig-log-dry"


@pytest.fixture
def diagnosed(tmp_path, monkeypatch, capsys):
    """Runs the command on a log of which a given law is missing; exit code and what it says."""
    monkeypatch.setenv(OWN_FOLDER, str(tmp_path / "effects"))
    monkeypatch.setenv("COLUMNS", "300")
    monkeypatch.setattr(command, "prepare_processes", lambda: None)
    monkeypatch.setattr(command, "as_json", lambda _: {})

    def run(missing, *more, name="sticky_membrane"):
        found = SimpleNamespace(missing=missing)
        monkeypatch.setattr(command, "diagnose", lambda *_, **__: found)
        code = main(["diagnose", LOG, "--json", "--save-effect", name, *more])
        return code, capsys.readouterr().err

    return run


def test_a_law_that_closes_the_gap_becomes_an_effect(diagnosed, tmp_path):
    code, said = diagnosed(missing_with())
    path = tmp_path / "effects" / "sticky_membrane.yaml"
    assert code == 0
    assert f"{path}: later diagnoses will try sticky_membrane" in said
    assert read_effect(path).apply(NOMINAL, 1.0).free == STICKY


@pytest.mark.parametrize("missing", [None, missing_with(closed=False)])
def test_where_there_is_none_that_is_said_and_nothing_is_written(diagnosed, tmp_path, missing):
    code, said = diagnosed(missing)
    assert code == 0
    assert "sticky_membrane is not saved: no free-form law closes the gap" in said
    assert not (tmp_path / "effects").exists()


@pytest.mark.parametrize("name", ["coulomb_friction", "Sticky", "none"])
def test_a_name_that_cannot_be_is_refused_before_any_work(diagnosed, tmp_path, monkeypatch, name):
    monkeypatch.setattr(command, "read_rig_log", pytest.fail)
    code, said = diagnosed(missing_with(), name=name)
    assert code == 2
    assert "--save-effect: expected" in said
    assert not (tmp_path / "effects").exists()


def test_a_file_that_is_there_is_replaced_only_with_force(diagnosed, tmp_path):
    stronger = replace(STICKY, asymmetry=0.5)
    assert diagnosed(missing_with())[0] == 0
    path = tmp_path / "effects" / "sticky_membrane.yaml"
    before = path.read_text()
    code, said = diagnosed(missing_with(stronger))
    assert code == 2
    assert "--force" in said
    assert path.read_text() == before
    assert diagnosed(missing_with(stronger), "--force")[0] == 0
    assert read_effect(path).apply(NOMINAL, 1.0).free == stronger
