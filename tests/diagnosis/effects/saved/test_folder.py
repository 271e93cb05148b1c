"""The user's own effects: where they are looked for, and that later diagnoses know them."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from saved_laws import saved

from diagnosis.effects import FITTED
from diagnosis.effects.saved.effect_file import effect_as_text
from diagnosis.effects.saved.folder import OWN_FOLDER, effects_folder, saved_effects
from models.errors import InvalidValue

ROOT = Path(__file__).parents[4]
BELOW = Path("needle-torsion") / "effects"


@pytest.fixture
def own(tmp_path, monkeypatch):
    """A folder of one's own, which has an effect."""
    folder = tmp_path / "effects"
    folder.mkdir()
    monkeypatch.setenv(OWN_FOLDER, str(folder))
    (folder / "sticky_membrane.yaml").write_text(effect_as_text(saved()))
    return folder


def test_the_folder_is_ones_own_or_that_of_data_or_in_the_home(tmp_path, monkeypatch):
    for variable in (OWN_FOLDER, "XDG_DATA_HOME"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    assert effects_folder() == tmp_path / "home" / ".local" / "share" / BELOW
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    assert effects_folder() == tmp_path / "data" / BELOW
    monkeypatch.setenv(OWN_FOLDER, str(tmp_path / "mine"))
    assert effects_folder() == tmp_path / "mine"


def test_who_has_no_home_has_no_effects(monkeypatch):
    def homeless():
        raise RuntimeError("Could not determine home directory.")

    for variable in (OWN_FOLDER, "XDG_DATA_HOME"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setattr(Path, "home", homeless)
    assert effects_folder() is None
    assert saved_effects(()) == {}


def test_a_folder_that_is_not_there_has_none(tmp_path, monkeypatch):
    monkeypatch.setenv(OWN_FOLDER, str(tmp_path / "nowhere"))
    assert saved_effects(()) == {}


def test_effects_are_found_by_the_names_of_their_files(own):
    (own / "notes.txt").write_text("no effect")
    (own / "another_law.yaml").write_text(effect_as_text(saved(name="another_law")))
    assert list(saved_effects(())) == ["another_law", "sticky_membrane"]


@pytest.mark.parametrize(
    ("name", "file"), [("coulomb_friction", "coulomb_friction"), ("sticky_membrane", "renamed")]
)
def test_a_name_that_is_taken_or_not_its_files_is_refused(own, name, file):
    path = own / f"{file}.yaml"
    path.write_text(effect_as_text(saved(name=name)))
    with pytest.raises(InvalidValue, match="rename the effect and its file") as caught:
        saved_effects(FITTED)
    assert caught.value.field == f"{path}: name"


def run(*arguments):
    """A Python that starts now, and so reads the user's folder."""
    return subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, check=False, timeout=300
    )


FIT = """
import json
import numpy as np
from diagnosis_fixtures import log_of
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import fit_effects
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.screening import screen

name = "sticky_membrane"
nominal = replay_nominal(log_of(LIBRARY[name].apply(NOMINAL, 1.7), seconds=6.0))
start = screen(nominal.problem, nominal.fit, name)[0].start
fit = fit_effects(nominal.problem, (name,), start)
covariance = np.linalg.inv(sum(j.T @ j for j in fit.jacobian) + np.diag(fit.parameterization.weights**2))
value = fit.parameterization.values(fit.x)[0]
print(json.dumps([value, value * covariance[0, 0] ** 0.5, fit.gap, nominal.fit.gap]))
"""


@pytest.mark.slow
def test_a_diagnosis_that_starts_later_finds_how_strong_a_saved_law_is(own, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(map(str, (ROOT, ROOT / "tests"))))
    told = run("-c", FIT)
    assert told.returncode == 0, told.stderr
    value, sigma, gap, nominal_gap = json.loads(told.stdout)
    assert nominal_gap > 2.0
    assert gap < 1.05
    assert sigma < 0.02
    assert value == pytest.approx(1.7, abs=4 * sigma)


@pytest.mark.slow
def test_a_diagnosis_names_a_saved_effect_that_it_cannot_read(own):
    (own / "broken.yaml").write_text("format: effect/1\nname: broken")
    told = run("-m", "scripts.main", "diagnose", "examples/rig-log-dry", "--json")
    said = "".join(told.stderr.split())
    assert told.returncode == 2
    assert "".join(f"{own / 'broken.yaml'}: title".split()) in said
    assert "Traceback" not in said
