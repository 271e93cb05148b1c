"""effect/1: what is read is what was saved, and what is wrong is named by file and field."""

import math

import pytest
import yaml
from saved_laws import EVERYTHING, SOFTENING, STICKY, saved

from diagnosis.effects.effect import Place
from diagnosis.effects.saved.effect_file import effect_as_text, read_effect
from diagnosis.replay.rig_parameters import NOMINAL
from models.errors import InvalidValue


@pytest.fixture
def written(tmp_path):
    """Reads an effect back from its file."""

    def back(one):
        path = tmp_path / f"{one.name}.yaml"
        path.write_text(effect_as_text(one))
        return read_effect(path)

    return back


@pytest.mark.parametrize("law", [STICKY, EVERYTHING], ids=["sticky", "every field"])
def test_a_law_comes_back_from_its_file_to_the_last_digit(written, law):
    effect = written(saved(law))
    assert effect.name == "sticky_membrane"
    assert effect.place is Place.INTERFACE
    assert effect.apply(NOMINAL, 1.0).free == law


def test_its_one_parameter_is_a_strength(written):
    effect = written(saved(EVERYTHING))
    (strength,) = effect.parameters
    assert (strength.name, strength.unit) == ("strength", "-")
    assert effect.apply(NOMINAL, 2.0).free == EVERYTHING.times(2.0)
    assert effect.remedy.format(strength=2.0).endswith("2.0 times as strong")


def test_elastic_tissue_yields_more_the_stronger_it_is(written):
    """Tissue that does not yield is the nominal one: a weak law is a stiff one."""
    elastic = {"stiffness_n_mm_per_rad_per_mm": 0.4, "time_constant_s": 0.7}
    effect = written(saved(STICKY, place=Place.TISSUE, **elastic))
    rig = effect.apply(NOMINAL, 2.0)
    assert rig.tissue_stiffness_n_mm_per_rad_per_mm == pytest.approx(0.2)
    assert rig.tissue_time_constant_s == 0.7


def test_two_saved_laws_stand_in_one_rig_unless_they_set_the_same_part(written):
    sticky, soft = written(saved(STICKY)), written(saved(SOFTENING))
    assert soft.apply(sticky.apply(NOMINAL, 1.0), 2.0).free == STICKY.beside(SOFTENING.times(2.0))
    every = written(saved(EVERYTHING))
    with pytest.raises(InvalidValue, match="asymmetry"):
        every.apply(every.apply(NOMINAL, 1.0), 2.0)


def of(*path, **changes):
    """Changes fields of what a file holds, at a path into it."""

    def change(content):
        inner = content
        for key in path:
            inner = inner[key]
        inner |= changes

    return change


CURVE = ("law", "curves", 0)
WRONG = {
    "format": (of(format="effect/2"), "format"),
    "name": (of(name="Sticky Membrane"), "name"),
    "the name of a verdict": (of(name="unknown"), "name"),
    "title": (of(title=3), "title"),
    "place": (of(place="nowhere"), "place"),
    "stiffness": (of(stiffness_n_mm_per_rad_per_mm=-1.0), "stiffness_n_mm_per_rad_per_mm"),
    "time constant": (of(time_constant_s=math.nan), "time_constant_s"),
    "a field too many": (of(colour="red"), "colour"),
    "no law": (of(law="viscous"), "law"),
    "a law of nothing": (of(law={}), "law"),
    "a field of the law too many": (of("law", curvs=[]), "law.curvs"),
    "asymmetry": (of("law", asymmetry=1.5), "law.asymmetry"),
    "yes for a number": (of("law", rate_range_rad_s=[True, 2.0]), "law.rate_range_rad_s.0"),
    "rates upside down": (of("law", rate_range_rad_s=[2.0, 0.1]), "law.rate_range_rad_s"),
    "too few rates": (of("law", rate_curve=[1.0]), "law.rate_curve"),
    "too many rates": (of("law", rate_curve=[1.0] * 24), "law.rate_curve"),
    "a factor below 0": (of("law", along_depth={"damping": [1.0, -2.0]}), "law.along_depth.damping"),
    "a further law": (
        of("law", "throughout", 0, kinetic_n_mm_per_mm=-1.0),
        "law.throughout.0.kinetic_n_mm_per_mm",
    ),
    "acts on": (of(*CURVE, acts_on="tisue"), "law.curves.0.acts_on"),
    "variable": (of(*CURVE, variable="weather"), "law.curves.0.variable"),
    "places": (of(*CURVE, places=[0.0, 40.0, 40.0]), "law.curves.0.places"),
    "values": (of(*CURVE, values=[1.0, 2.0]), "law.curves.0.values"),
    "a value below 0": (of(*CURVE, values=[1.0, 2.0, -1.0]), "law.curves.0.values"),
    "an infinite value": (of(*CURVE, values=[1.0, 2.0, math.inf]), "law.curves.0.values.2"),
    "a short period": (of(*CURVE, period=80.0), "law.curves.0.period"),
}


@pytest.mark.parametrize(("change", "field"), WRONG.values(), ids=WRONG)
def test_a_wrong_file_is_refused_by_file_and_field(tmp_path, change, field):
    content = yaml.safe_load(effect_as_text(saved(EVERYTHING)))
    change(content)
    path = tmp_path / "sticky_membrane.yaml"
    path.write_text(yaml.safe_dump(content))
    with pytest.raises(InvalidValue) as caught:
        read_effect(path)
    assert caught.value.field == f"{path}: {field}"
    assert "found" in str(caught.value)


@pytest.mark.parametrize("field", ["name", "title", "place", "law"])
def test_a_field_that_is_not_there_is_named(tmp_path, field):
    content = yaml.safe_load(effect_as_text(saved()))
    del content[field]
    path = tmp_path / "sticky_membrane.yaml"
    path.write_text(yaml.safe_dump(content))
    with pytest.raises(InvalidValue) as caught:
        read_effect(path)
    assert caught.value.field == f"{path}: {field}"


@pytest.mark.parametrize("text", ["", "[1, 2]", "law: ["])
def test_what_is_no_effect_at_all_is_refused_by_its_file(tmp_path, text):
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    with pytest.raises(InvalidValue, match=r"mine\.yaml"):
        read_effect(path)
