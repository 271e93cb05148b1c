"""Which free-form laws are saved, and under which names."""

from dataclasses import fields, replace

import numpy as np
import pytest
import yaml
from free_forms import covered
from saved_laws import EVERYTHING, SOFTENING, STICKY, missing_with, saved

from diagnosis.effects import FITTED
from diagnosis.effects.effect import Place
from diagnosis.effects.saved.effect_file import effect_as_text, read_effect
from diagnosis.effects.saved.folder import OWN_FOLDER
from diagnosis.freeform.families import families_of
from diagnosis.freeform.save import as_file, file_of
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable
from models.errors import InvalidValue

ELASTIC = {"tissue_stiffness_n_mm_per_rad_per_mm", "tissue_time_constant_s"}
ONE = Curve(acts_on=ActsOn.TISSUE, variable=Variable.TIME, places=(0.0, 1.0), values=(1.0, 2.0))


@pytest.mark.parametrize("law", [STICKY, EVERYTHING, SOFTENING], ids=["sticky", "every field", "soft"])
def test_a_law_that_closes_the_gap_is_saved_as_it_was_fitted(tmp_path, law):
    path = tmp_path / "sticky_membrane.yaml"
    path.write_text(as_file(missing_with(law), path.stem))
    assert read_effect(path).apply(NOMINAL, 1.0).free == law
    assert path.read_text() == effect_as_text(saved(law))


def test_of_elastic_tissue_stiffness_and_time_constant_are_saved_with_it():
    elastic = {"tissue_stiffness_n_mm_per_rad_per_mm": 0.4, "tissue_time_constant_s": 0.7}
    content = yaml.safe_load(as_file(missing_with(place=Place.TISSUE, **elastic), "soft"))
    assert content["stiffness_n_mm_per_rad_per_mm"] == 0.4
    assert content["time_constant_s"] == 0.7


def test_by_how_much_dry_friction_gives_is_saved_where_the_law_is_of_that(tmp_path):
    path = tmp_path / "healing_bonds.yaml"
    path.write_text(as_file(missing_with(presliding_deg=2.5), path.stem))
    assert read_effect(path).apply(NOMINAL, 1.0).presliding_deg == 2.5
    path.write_text(as_file(missing_with(), path.stem))
    other = replace(NOMINAL, presliding_deg=0.3)
    assert read_effect(path).apply(other, 1.0).presliding_deg == 0.3


def test_laws_that_were_fitted_together_are_saved_as_one_effect():
    """The rig of the fit has both; so has the file, with the numbers of elastic tissue of either."""
    one, other = missing_with(STICKY), missing_with(SOFTENING, place=Place.TISSUE)
    elastic = {"tissue_stiffness_n_mm_per_rad_per_mm": 0.4}
    both = missing_with(STICKY.beside(SOFTENING), **elastic)
    both = replace(both, beside=(other.law,), best=replace(both.best, others=(other.best.family,)))
    content = yaml.safe_load(as_file(both, "soft_and_sticky"))
    assert content["stiffness_n_mm_per_rad_per_mm"] == 0.4
    assert content["title"] == f"{one.best.family.effect.title}, and {other.best.family.effect.title}"
    once = replace(both, beside=(replace(other.law, variable="event"),))
    assert as_file(once, "soft_and_sticky") == ""


TURNS = np.concatenate([np.linspace(0, 400, 300), np.linspace(400, -200, 400)])
SEEN = (0.5 * TURNS, 0.005 * TURNS)
FAMILIES = families_of(covered(TURNS, tip=0.9 * TURNS, torque=0.01 * TURNS, speed=2.0, seen=SEEN))


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_no_part_of_a_law_is_lost_where_it_is_saved(family):
    """What a family changes of the rig is what its file keeps: the law, and elastic tissue's numbers."""
    parameters = family.effect.parameters
    moved = [p.from_fit(p.to_fit(p.start[0]) + 0.1) for p in parameters]
    values = [min(max(v, p.low), p.high) for v, p in zip(moved, parameters, strict=True)]
    rig = family.effect.apply(NOMINAL, *values)
    kept = {"free", "presliding_deg"} | (ELASTIC if family.place is Place.TISSUE else set())
    changed = {f.name for f in fields(rig) if getattr(rig, f.name) != getattr(NOMINAL, f.name)}
    if family.unit == "s":  # a clock is of a recording: what has one is not saved
        assert changed <= {"tip_clock_ratio", "torque_clock_ratio"}
        return
    assert "free" in changed
    assert changed <= kept


def of_a_clock(missing):
    """The same, where what is off is a time."""
    return replace(missing, law=replace(missing.law, unit="s"))


UNSAVED = {
    "nothing was looked for": None,
    "no law explains more": missing_with(curve=False),
    "the gap stays open": missing_with(closed=False),
    "it happened once": missing_with(variable="event"),
    "it is a clock": of_a_clock(missing_with()),
    "it is of an effect of the library": missing_with(free=None),
    "a curve is of one trial": missing_with(FreeLaw(curves=(replace(ONE, trial="trial_01.csv"),))),
}


@pytest.mark.parametrize("missing", UNSAVED.values(), ids=UNSAVED)
def test_what_no_library_could_have_is_not_saved(missing):
    assert as_file(missing, "sticky_membrane") == ""


def test_an_effect_goes_to_the_file_of_its_name(tmp_path, monkeypatch):
    monkeypatch.setenv(OWN_FOLDER, str(tmp_path))
    assert file_of("sticky_membrane") == tmp_path / "sticky_membrane.yaml"


@pytest.mark.parametrize(
    "name",
    ["", "ab", "Sticky", "a-b-c", "../mine", "1st", "a" * 42, "none", "unknown", *list(FITTED)[:2]],
)
def test_a_name_that_is_none_or_taken_is_refused_before_anything_is_done(tmp_path, monkeypatch, name):
    monkeypatch.setenv(OWN_FOLDER, str(tmp_path))
    with pytest.raises(InvalidValue) as caught:
        file_of(name)
    assert caught.value.field == "--save-effect"


def test_who_has_no_home_is_told_of_the_variable(monkeypatch):
    monkeypatch.setattr("diagnosis.freeform.save.effects_folder", lambda: None)
    with pytest.raises(InvalidValue, match=f"set {OWN_FOLDER} to a folder"):
        file_of("sticky_membrane")
