"""Ranges of the strengths of effects that the diagnosis does not model."""

from collections.abc import Callable

from numpy.random import Generator

from validation.logs.profiles import log_uniform
from validation.logs.strengths.family import (
    ByStrength,
    StrengthFamily,
    inverse,
    only,
    periodic,
    signed,
    with_others,
)


def _yielding(**others: tuple[float, float]) -> Callable[[Generator], ByStrength]:
    """The strength is the compliance of the tissue; the others are drawn uniformly from their ranges."""

    def draw(rng: Generator) -> ByStrength:
        drawn = {"time_constant": log_uniform(rng, 0.15, 3.0)}
        drawn |= {other: rng.uniform(*ends) for other, ends in others.items()}
        return lambda strength: {"stiffness": 1 / strength, **drawn}

    return draw


def _once(name: str) -> Callable[[Generator], ByStrength]:
    """The strength is the magnitude of that parameter; the event is in one of the first three trials."""

    def draw(rng: Generator) -> ByStrength:
        sign, trial, share = rng.choice([-1.0, 1.0]), float(rng.integers(3)), rng.uniform(0.2, 0.6)
        return lambda strength: {name: sign * strength, "trial": trial, "share": share}

    return draw


def _plastic(rng: Generator) -> ByStrength:
    """The strength is 1 over the slope beyond the torque at which the shaft yields."""
    torque = log_uniform(rng, 0.3, 2.0)
    return lambda strength: {"slope": 1 / strength, "torque": torque}


UNMODELLED_FAMILIES: dict[str, StrengthFamily] = {
    "lubrication": StrengthFamily(low=0.05, high=0.85, draw=with_others("share", angle=(200, 1500))),
    "damping_decay": StrengthFamily(low=0.05, high=0.9, draw=with_others("share", time=(4, 25))),
    "saturating_damping": StrengthFamily(low=0.02, high=20, draw=inverse("rate")),
    "one_way_friction": StrengthFamily(
        low=1e-4, high=2e-2, draw=with_others("level", asymmetry=(0.4, 0.9))
    ),
    "axially_relieved_friction": StrengthFamily(
        low=1e-4, high=2e-2, draw=with_others("level", speed=(0.5, 4.0))
    ),
    "friction_of_depth": StrengthFamily(
        low=1e-4, high=2e-2, draw=with_others("level", exponent=(1.0, 2.5))
    ),
    "friction_ageing": StrengthFamily(
        low=1e-4,
        high=1e-2,
        draw=with_others("growth", level=(1e-4, 1e-3), time=(0.2, 1.0), angle=(0.5, 5.0)),
    ),
    "damping_gradient": StrengthFamily(low=0.1, high=0.95, draw=signed("gradient")),
    "softening_tissue": StrengthFamily(low=2, high=300, draw=_yielding(share=(0.6, 0.95), time=(4, 25))),
    "stiffening_depth": StrengthFamily(low=2, high=300, draw=_yielding(growth=(3, 30))),
    "hardening_tissue": StrengthFamily(low=2, high=300, draw=_yielding(angle=(2, 20))),
    "slipping_chuck": StrengthFamily(low=0.1, high=20, draw=inverse("torque")),
    "soft_play": StrengthFamily(low=0.3, high=60, draw=with_others("angle", torque=(0.1, 1.5))),
    "chuck_jump": StrengthFamily(low=0.3, high=90, draw=_once("angle")),
    "drive_creep": StrengthFamily(low=2e-3, high=2, draw=signed("rate")),
    "eccentric_encoder": StrengthFamily(
        low=0.05, high=30, draw=with_others("amplitude", phase=(-180, 180))
    ),
    "torque_ripple": StrengthFamily(low=5e-3, high=0.5, draw=periodic("amplitude", "teeth", 3, 12)),
    "hardening_shaft": StrengthFamily(low=30, high=3e5, draw=only("coefficient")),
    "permanent_set": StrengthFamily(low=0.01, high=5, draw=_plastic),
    "tip_friction": StrengthFamily(low=5e-3, high=1.5, draw=only("level")),
    "tip_in_fibres": StrengthFamily(low=3e-3, high=0.8, draw=with_others("torque", phase=(-90, 90))),
    "tip_sensor_lag": StrengthFamily(low=5e-3, high=2.0, draw=only("time_constant")),
    "tip_sensor_cubic": StrengthFamily(low=0.01, high=30, draw=signed("cubic")),
    "tip_sensor_periodic": StrengthFamily(low=0.1, high=15, draw=periodic("amplitude", "cycles", 2, 4)),
    "tip_sensor_play": StrengthFamily(low=0.3, high=40, draw=only("width")),
    "tip_sensor_jump": StrengthFamily(low=0.3, high=90, draw=_once("angle")),
    "torque_drift": StrengthFamily(low=1e-4, high=0.05, draw=signed("rate")),
    "one_sided_torque_gain": StrengthFamily(low=2e-3, high=0.5, draw=signed("share")),
    "axial_crosstalk": StrengthFamily(low=2e-3, high=0.3, draw=signed("gain")),
}
