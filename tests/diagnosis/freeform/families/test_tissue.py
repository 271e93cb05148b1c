"""Free laws of the tissue: where they are constant, they are elastic tissue of the library."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.tissue import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
FAMILIES = {family.name: family for family in families(covered(ANGLE, tip=ANGLE))}
ELASTIC = LIBRARY["tissue_viscoelasticity"].apply(NOMINAL, 0.01, 0.4)
FLAT = [0.0] * 8


@pytest.mark.parametrize("name", list(FAMILIES))
def test_a_constant_curve_is_elastic_tissue_of_the_library(name):
    effect = FAMILIES[name].effect
    flat = [0.0] * (len(effect.parameters) - 2)
    # Parts of the shaft meet in places of their own: another mesh, second order in its elements.
    within = 1e-3 if name.endswith("position") else 1e-6
    constant, stiffer = (effect.apply(NOMINAL, 0.01, 0.4, c, *flat[1:]) for c in (0.0, 0.2))
    assert same_readings(ANGLE, constant, ELASTIC, within=within)
    assert not same_readings(ANGLE, stiffer, ELASTIC, within=within)


def test_the_curve_is_the_stiffness():
    _, stiffness = FAMILIES["elastic tissue over time"].curve(0.01, 0.4, np.log(2.0), *FLAT[1:])
    np.testing.assert_allclose(stiffness, 0.02)


def test_it_is_of_what_the_log_has():
    says = {family.says for family in FAMILIES.values()}
    assert says == {"time", "history", "position", "torque"}
    assert all(family.place is Place.TISSUE for family in FAMILIES.values())
