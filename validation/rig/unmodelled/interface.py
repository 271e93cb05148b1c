"""Effects between shaft and tissue that the diagnosis does not model."""

import numpy as np

from validation.rig.laws.parameters import LawParameters
from validation.rig.unmodelled.effect import Parameters, UnmodelledEffect


def lubrication(law: LawParameters, p: Parameters) -> LawParameters:
    """Damping falls by `share` as the shaft slips: 1 - share (1 - exp(-travelled angle / angle))."""
    return law._replace(worn_share=p["share"], worn_angle=np.radians(p["angle"]))


def damping_decay(law: LawParameters, p: Parameters) -> LawParameters:
    """Damping falls by `share` as tissue relaxes after it is touched: 1 - share (1 - exp(-t / time))."""
    return law._replace(decay_share=p["share"], decay_time=p["time"])


def saturating_damping(law: LawParameters, p: Parameters) -> LawParameters:
    """Viscous torque damping w / (1 + |w| / rate) of a film that gives way: it tends to damping rate."""
    return law._replace(saturation=p["rate"])


def one_way_friction(law: LawParameters, p: Parameters) -> LawParameters:
    """Dry friction of level (1 + asymmetry) for positive slip, (1 - asymmetry) for negative."""
    return law._replace(coulomb=p["level"], asymmetry=p["asymmetry"])


def axially_relieved_friction(law: LawParameters, p: Parameters) -> LawParameters:
    """Dry friction that a film relieves where the needle slides: level exp(-|axial speed| / speed)."""
    return law._replace(coulomb=p["level"], relief_speed=p["speed"])


def friction_of_depth(law: LawParameters, p: Parameters) -> LawParameters:
    """Dry friction of a tissue that presses harder further in: level (depth / 100 mm)^exponent."""
    return law._replace(coulomb=p["level"], pressing=p["exponent"])


def friction_ageing(law: LawParameters, p: Parameters) -> LawParameters:
    """Dry friction that grows with rest: level + growth log(1 + age / time).

    The age is that of the contact: it rises with time and is renewed by slip over `angle`.
    """
    return law._replace(
        coulomb=p["level"],
        ageing=p["growth"],
        ageing_time=p["time"],
        ageing_angle=np.radians(p["angle"]),
    )


HERE = ("interface",)
EFFECTS = {
    "lubrication": UnmodelledEffect(place=HERE, variables=("history", "time"), law=lubrication),
    "damping_decay": UnmodelledEffect(place=HERE, variables=("time",), law=damping_decay),
    "saturating_damping": UnmodelledEffect(place=HERE, variables=("rate",), law=saturating_damping),
    "one_way_friction": UnmodelledEffect(place=HERE, variables=("direction",), law=one_way_friction),
    "axially_relieved_friction": UnmodelledEffect(
        place=HERE, variables=("axial_speed",), law=axially_relieved_friction
    ),
    "friction_of_depth": UnmodelledEffect(
        place=HERE, variables=("position", "depth"), law=friction_of_depth
    ),
    "friction_ageing": UnmodelledEffect(place=HERE, variables=("history",), law=friction_ageing),
}
