"""What changes with the depth becomes layers of tissue."""

import numpy as np
import pytest

from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.free_law import FreeLaw
from models.errors import InvalidValue
from models.tissue import Interface, Layer, Tissue

LAW = Interface(viscous_n_mm_s_per_mm=0.02, kinetic_n_mm_per_mm=0.001)
ELASTIC = LAW.but(stiffness_n_mm_per_rad_per_mm=0.05, time_constant_s=0.3)


def tissue_with(along, law=LAW):
    """Tissue of one layer with a law along the depth."""
    return FreeLaw(along_depth=along).tissue(Tissue(layers=(Layer(interface=law),)))


def of_layers(tissue, name):
    """A field of the laws of all layers."""
    return [getattr(layer.interface, name) for layer in tissue.layers]


def test_parts_share_the_inserted_length():
    found = tissue_with(AlongDepth(damping=(0.5, 1.0, 1.5)))
    assert of_layers(found, "viscous_n_mm_s_per_mm") == pytest.approx([0.01, 0.02, 0.03])
    assert of_layers(found, "kinetic_n_mm_per_mm") == [0.001] * 3
    np.testing.assert_allclose(found.boundaries_mm(90.0), [0, 30, 60, 90])


def test_or_lie_at_fixed_depths():
    found = tissue_with(AlongDepth(friction_n_mm_per_mm=(0.0, 0.002, 0.004), thickness_mm=40.0))
    assert of_layers(found, "kinetic_n_mm_per_mm") == pytest.approx([0.001, 0.003, 0.005])
    assert of_layers(found, "viscous_n_mm_s_per_mm") == [0.02] * 3
    np.testing.assert_allclose(found.boundaries_mm(100.0), [0, 40, 80, 100])
    np.testing.assert_allclose(found.boundaries_mm(70.0), [0, 40, 70])


def test_friction_may_be_shared_with_the_axial_motion():
    found = tissue_with(AlongDepth(friction_n_mm_per_mm=(0.0, 0.002), shared=True))
    assert of_layers(found, "shared_n_mm_per_mm") == [0.0, 0.002]
    assert of_layers(found, "kinetic_n_mm_per_mm") == [0.001] * 2
    assert AlongDepth(friction_n_mm_per_mm=(0.0, 0.002), shared=True).times(0.5).shared


def test_stiffness_is_of_elastic_tissue_alone():
    along = AlongDepth(stiffness=(1.0, 2.0))
    name = "stiffness_n_mm_per_rad_per_mm"
    assert of_layers(tissue_with(along, ELASTIC), name) == pytest.approx([0.05, 0.1])
    assert of_layers(tissue_with(along), name) == [None, None]


def test_strength_raises_factors_and_multiplies_friction():
    along = AlongDepth(damping=(4.0,), stiffness=(9.0,), friction_n_mm_per_mm=(0.01,), thickness_mm=5.0)
    half = along.times(0.5)
    assert (half.damping, half.stiffness, half.friction_n_mm_per_mm) == ((2.0,), (3.0,), (0.005,))
    assert (half.thickness_mm, half.parts) == (5.0, 1)


@pytest.mark.parametrize(
    ("field", "value"),
    [("damping", (1.0, 0.0)), ("friction_n_mm_per_mm", (-0.1,)), ("thickness_mm", -1.0)],
)
def test_what_cannot_be_is_refused(field, value):
    with pytest.raises(InvalidValue, match=field):
        AlongDepth(**{field: value})
