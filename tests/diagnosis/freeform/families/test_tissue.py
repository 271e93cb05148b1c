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
    along = [1.0] if "follows" in {p.name for p in effect.parameters} else []
    flat = [0.0] * (len(effect.parameters) - 2 - len(along))
    # Parts of the shaft meet in places of their own: another mesh, second order in its elements.
    within = 1e-3 if name.endswith("position") else 1e-6
    constant, stiffer = (effect.apply(NOMINAL, 0.01, 0.4, *along, c, *flat[1:]) for c in (0.0, 0.2))
    assert same_readings(ANGLE, constant, ELASTIC, within=within)
    assert not same_readings(ANGLE, stiffer, ELASTIC, within=within)


def test_the_curve_is_the_stiffness():
    _, stiffness = FAMILIES["elastic tissue over time"].curve(0.01, 0.4, 0.5, np.log(2.0), *FLAT[1:])
    np.testing.assert_allclose(stiffness, 0.02)


def test_its_viscosity_may_stay_while_its_stiffness_changes():
    """Twice as stiff throughout: the same as half the time constant, as k tau stays."""
    effect = FAMILIES["elastic tissue over time"].effect
    stays, goes_along = (
        effect.apply(NOMINAL, 0.01, 0.4, along, np.log(2.0), *FLAT[1:]) for along in (0.0, 1.0)
    )
    half, same = (LIBRARY["tissue_viscoelasticity"].apply(NOMINAL, 0.02, t) for t in (0.2, 0.4))
    assert same_readings(ANGLE, stays, half, within=1e-6)
    assert same_readings(ANGLE, goes_along, same, within=1e-6)
    assert not same_readings(ANGLE, stays, same, within=1e-3)


def test_it_is_of_what_the_log_has():
    says = {family.says for family in FAMILIES.values()}
    assert says == {"time", "history", "position", "torque"}
    assert all(family.place is Place.TISSUE for family in FAMILIES.values())
