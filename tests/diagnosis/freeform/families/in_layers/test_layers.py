"""Free laws in layers: where all layers are alike, they are effects of the library."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import DAMPING, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_layers.layers import FINE, families
from diagnosis.freeform.families.interface import PARTS
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
STILL = covered(ANGLE, tip=ANGLE)
DEEPER = replace(STILL, ends={**STILL.ends, Variable.DEPTH: (40.0, 80.0)})
FAMILIES = {family.name: family for family in families(DEEPER)}
SLIDING = {
    family.name: family
    for family in families(replace(STILL, ends={**STILL.ends, Variable.AXIAL_SPEED: (0.0, 2.0)}))
}
FLAT = [0.0] * (PARTS - 1)
DRY, THICK, ELASTIC = (
    f"{what} over position, in layers" for what in ("dry friction", "damping", "elastic tissue")
)
FLAT_OF = {DRY: FLAT, THICK: [0.0] * (FINE - 1), ELASTIC: FLAT}
ONE = "damping over position, in one layer"
DRY_ONE = "dry friction over position, in one layer"
SHARED_ONE = f"{DRY_ONE}, shared with the axial motion"
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
    flat = FLAT_OF[name]
    alike, more = (FAMILIES[name].effect.apply(NOMINAL, *first, c, *flat) for c in (0.0, 0.3))
    assert same_readings(ANGLE, alike, plain, within=MESH)
    assert not same_readings(ANGLE, more, plain, within=MESH)


def test_the_curve_is_told_by_depth_below_the_surface():
    deepest = max(trial.schedule.inserted_mm.max() for trial in DEEPER.problem.log.trials)
    depth, damping = FAMILIES[THICK].curve(0.0, *FLAT_OF[THICK])
    np.testing.assert_allclose(damping, DAMPING)
    np.testing.assert_allclose(depth, deepest * (np.arange(FINE) + 0.5) / FINE)
    _, level = FAMILIES[DRY].curve(0.002, np.log(2.0), *FLAT)
    np.testing.assert_allclose(level, 0.004)
    _, stiffness = FAMILIES[ELASTIC].curve(0.01, 0.4, np.log(2.0), *FLAT)
    np.testing.assert_allclose(stiffness, 0.02)


def test_at_one_inserted_length_only_friction_is_asked_for():
    assert set(FAMILIES) == {*PLAIN, ONE, DRY_ONE}
    assert SHARED_ONE in SLIDING
    assert [family.name for family in families(STILL)] == [DRY, DRY_ONE]


def test_one_dry_layer_that_spans_all_is_even_friction():
    """But for its first millimetre: 1 in 80 mm or more."""
    nearly_all = FAMILIES[DRY_ONE].effect.apply(NOMINAL, 1.0, 500.0, 0.003)
    even = LIBRARY["coulomb_friction"].apply(NOMINAL, 0.003)
    assert same_readings(ANGLE, nearly_all, even, within=1.0 / 80)
    assert not same_readings(ANGLE, nearly_all, NOMINAL, within=1.0 / 80)
    depth, level = FAMILIES[DRY_ONE].curve(30.0, 8.0, 0.02)
    np.testing.assert_allclose(depth, (0.0, 30.0, 30.0, 38.0, 38.0, 68.0), atol=2e-3)
    np.testing.assert_allclose(level, (0.0, 0.0, 0.02, 0.02, 0.0, 0.0))


def test_where_the_needle_slides_friction_of_one_layer_may_be_shared_with_that():
    own = SLIDING[SHARED_ONE].effect.apply(NOMINAL, 30.0, 8.0, 0.02)
    free = own.free.along_depth
    assert (free.friction_n_mm_per_mm, free.thicknesses_mm) == ((0.0, 0.02, 0.0), (30.0, 8.0))
    assert free.shared
    assert not SLIDING[DRY_ONE].effect.apply(NOMINAL, 30.0, 8.0, 0.02).free.along_depth.shared


def test_one_layer_like_the_others_is_none():
    one, other = (FAMILIES[ONE].effect.apply(NOMINAL, 30.0, 8.0, times) for times in (1.0, 5.0))
    assert same_readings(ANGLE, one, NOMINAL, within=MESH)
    assert not same_readings(ANGLE, other, NOMINAL, within=MESH)


def test_one_layer_that_spans_all_is_another_damping():
    """But for its first millimetre: 0.3 of 1 in 80 mm or more."""
    nearly_all = FAMILIES[ONE].effect.apply(NOMINAL, 1.0, 500.0, 1.3)
    assert same_readings(ANGLE, nearly_all, RigParameters(damping_scale=1.3), within=0.3 / 80)
    depth, damping = FAMILIES[ONE].curve(30.0, 8.0, 5.0)
    assert (np.diff(depth) > 0).all()
    np.testing.assert_allclose(depth, (0.0, 30.0, 30.0, 38.0, 38.0, 68.0), atol=2e-3)
    np.testing.assert_allclose(damping, DAMPING * np.array([1, 1, 5, 5, 1, 1]))
