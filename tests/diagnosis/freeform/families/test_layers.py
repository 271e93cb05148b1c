"""Free laws in layers: where all layers are alike, they are effects of the library."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import DAMPING, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.interface import PARTS
from diagnosis.freeform.families.layers import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
STILL = covered(ANGLE, tip=ANGLE)
DEEPER = replace(STILL, ends={**STILL.ends, Variable.DEPTH: (40.0, 80.0)})
FAMILIES = {family.name: family for family in families(DEEPER)}
FLAT = [0.0] * (PARTS - 1)
DRY, THICK, ELASTIC = (
    f"{what} over position, in layers" for what in ("dry friction", "damping", "elastic tissue")
)
MESH = 1e-3  # layers meet in places of their own: another mesh, second order in its elements
PLAIN = {
    DRY: (
        (0.001,),
        LIBRARY["coulomb_friction"].apply(NOMINAL, 0.001),
    ),
    THICK: ((), NOMINAL),
    ELASTIC: (
        (0.01, 0.4),
        LIBRARY["tissue_viscoelasticity"].apply(NOMINAL, 0.01, 0.4),
    ),
}


@pytest.mark.parametrize("name", list(PLAIN))
def test_layers_that_are_alike_are_no_layers(name):
    first, plain = PLAIN[name]
    alike, more = (FAMILIES[name].effect.apply(NOMINAL, *first, c, *FLAT) for c in (0.0, 0.3))
    assert same_readings(ANGLE, alike, plain, within=MESH)
    assert not same_readings(ANGLE, more, plain, within=MESH)


def test_the_curve_is_told_by_depth_below_the_surface():
    deepest = max(trial.schedule.inserted_mm.max() for trial in DEEPER.problem.log.trials)
    depth, damping = FAMILIES[THICK].curve(0.0, *FLAT)
    np.testing.assert_allclose(damping, DAMPING)
    np.testing.assert_allclose(depth, deepest * (np.arange(PARTS) + 0.5) / PARTS)
    _, level = FAMILIES[DRY].curve(0.002, np.log(2.0), *FLAT)
    np.testing.assert_allclose(level, 0.004)
    _, stiffness = FAMILIES[ELASTIC].curve(0.01, 0.4, np.log(2.0), *FLAT)
    np.testing.assert_allclose(stiffness, 0.02)


def test_at_one_inserted_length_only_friction_is_asked_for():
    assert set(FAMILIES) == set(PLAIN)
    assert [family.name for family in families(STILL)] == [DRY]
