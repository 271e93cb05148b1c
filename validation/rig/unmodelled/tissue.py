"""Effects of the tissue that the diagnosis does not model: of its layers, and of how it yields."""

import math

from validation.rig.laws.parameters import LawParameters
from validation.rig.unmodelled.effect import Parameters, UnmodelledEffect


def damping_gradient(law: LawParameters, p: Parameters) -> LawParameters:
    """Damping grows evenly along the inserted shaft from 1 - gradient to 1 + gradient of its mean."""
    return law._replace(gradient=p["gradient"])


def softening_tissue(law: LawParameters, p: Parameters) -> LawParameters:
    """Tissue that yields more and more: stiffness (1 - share (1 - exp(-t / time)))."""
    softened = _yielding(law, p)
    return softened._replace(softened_share=p["share"], softening_time=p["time"])


def stiffening_depth(law: LawParameters, p: Parameters) -> LawParameters:
    """Tissue that yields less further in: stiffness (1 + growth depth / 100 mm)."""
    return _yielding(law, p)._replace(stiffening=p["growth"])


def hardening_tissue(law: LawParameters, p: Parameters) -> LawParameters:
    """Fibres tighten: the elastic torque is stiffness twist (1 + (twist / angle)^2)."""
    return _yielding(law, p)._replace(tissue_hardening=math.radians(p["angle"]) ** -2)


def _yielding(law: LawParameters, p: Parameters) -> LawParameters:
    """Stiffness per mm at the start, at rest and at the entry, and its retardation time."""
    return law._replace(compliance=1 / p["stiffness"], retardation=p["time_constant"])


HERE = ("tissue",)
EFFECTS = {
    # Layers of tissue, or an interface whose law changes along it: one law.
    "damping_gradient": UnmodelledEffect(
        place=("tissue", "interface"), variables=("position",), law=damping_gradient
    ),
    "softening_tissue": UnmodelledEffect(place=HERE, variables=("time",), law=softening_tissue),
    "stiffening_depth": UnmodelledEffect(
        place=HERE, variables=("position", "depth"), law=stiffening_depth
    ),
    "hardening_tissue": UnmodelledEffect(place=HERE, variables=("torque",), law=hardening_tissue),
}
