"""The whole study, and its command."""

import json

import pytest
from reference_fits import fit_with
from rich.console import Console

from diagnosis.report.fallible import Page
from models.errors import OutputExists
from scripts import published_figures
from studies.published import study as study_module
from studies.published.report import files

PAGE = Page(text="a page", lacks=())  # its pictures take a second


def test_the_study_has_both_materials_and_says_how_far_it_is(study, progress):
    assert (study.plastisol.material, study.gelatin.material) == ("plastisol", "gelatin")
    assert study.warnings == ()
    shares = [share for _, share in progress]
    assert shares == sorted(shares)
    assert (shares[0], shares[-1]) == (0.0, 0.7)
    assert progress[0][0] == "gelatin"


def test_stages_that_did_not_converge_are_warned_of():
    class Replay:
        def unconverged(self, rig):
            return 3

    (said,) = study_module._not_converged([fit_with(("a", "b"), 1.0)], Replay())
    assert said == "a and b: 3 stages of the simulation did not converge"


def test_the_command_prints_the_json_that_it_writes_and_overwrites_nothing(
    study, tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(published_figures, "run_published_study", lambda progress: study)
    monkeypatch.setattr(files, "page", lambda study: PAGE)
    folder = tmp_path / "out"
    assert published_figures.run(folder, json_only=True, force=False, console=Console()) == 0
    printed = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert printed == json.loads((folder / "paper.json").read_text(), parse_constant=pytest.fail)
    with pytest.raises(OutputExists):
        published_figures.run(folder, json_only=True, force=False, console=Console())


def test_the_command_prints_a_summary_for_people(study, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(files, "page", lambda study: PAGE)
    monkeypatch.setattr(published_figures, "run_published_study", lambda progress: study)
    assert published_figures.run(None, json_only=False, force=False, console=Console(width=200)) == 0
    printed = capsys.readouterr().out
    assert printed.index(
        "Explained: base_servo and shear_thinning explains the 8 figures"
    ) < printed.index("Stated model and published figures")
    assert "wrote      out/paper/paper.html" in printed
    assert printed.index("Fits to the tables that come nearest") < printed.index("Steered insertions")
