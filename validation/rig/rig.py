"""The rig: a needle in tissue, and its effects."""

import math
from dataclasses import dataclass, field

from validation.rig.laws.parameters import LawParameters
from validation.rig.modelled import (
    LAW_FIELDS,
    SENSOR_FIELDS,
    WRONG_CONSTANT_FIELDS,
    Effects,
)
from validation.rig.unmodelled.library import EFFECTS, UNLISTED, UNMODELLED

NEUTRAL = SENSOR_FIELDS | WRONG_CONSTANT_FIELDS


@dataclass(frozen=True, kw_only=True)
class IndependentRig:
    """A needle in tissue.

    Attributes:
      effects: modelled effects, as in `modelled`.
      outside: effects that the diagnosis does not model, with parameters as in `unmodelled`.

    Raises:
      ValueError: an effect is unknown, or its parameters are not those of `modelled`.
    """

    damping_n_mm_s_per_mm: float
    diameter_mm: float = 0.59
    shear_modulus_gpa: float = 27.2
    effects: Effects = field(default_factory=dict)
    outside: Effects = field(default_factory=dict)

    def __post_init__(self) -> None:
        known = {name: sorted(fields) for name, fields in (LAW_FIELDS | NEUTRAL).items()}
        for effect, parameters in self.effects.items():
            if effect not in known:
                raise ValueError(f"effects: expected some of {', '.join(known)}, found {effect!r}")
            if sorted(parameters) != known[effect]:
                raise ValueError(
                    f"effects: expected {effect} with {known[effect]}, found {sorted(parameters)}"
                )
        for effect in self.outside:
            if effect not in (*UNMODELLED, *UNLISTED):
                raise ValueError(f"outside: expected some of {', '.join(UNMODELLED)}, found {effect!r}")

    def law(self) -> LawParameters:
        """Parameters of the laws, in the units of `laws`."""
        diameter_mm = self.diameter_mm * (1 + self.unlisted("diameter_error", "share"))
        rigidity = math.pi * diameter_mm**4 / 32 * self.shear_modulus_gpa * 1e3
        law = LawParameters(rigidity, self.damping_n_mm_s_per_mm, diameter_mm / 2)
        for effect, parameters in self.effects.items():
            for name, target in LAW_FIELDS.get(effect, {}).items():
                law = law._replace(**{target: _in_law(target, law, parameters[name])})
        for effect, parameters in self.outside.items():
            if effect in EFFECTS and (changed := EFFECTS[effect].law):
                law = changed(law, parameters)
        return law

    def sensor(self, effect: str, parameter: str) -> float:
        """A parameter of an effect of the sensors, which is in no law; or its neutral value."""
        return float(self.effects.get(effect, NEUTRAL[effect])[parameter])

    def unlisted(self, constant: str, parameter: str) -> float:
        """Error of a constant; 0 if it is right."""
        return float(self.outside.get(constant, {}).get(parameter, 0.0))


def _in_law(name: str, law: LawParameters, value: float) -> float:
    """A parameter's value in the units of the law."""
    if name in ("rigidity", "damping"):
        return float(getattr(law, name) * value)
    if name in ("compliance", "base_compliance"):
        return 1.0 / value
    if name in ("half_gap", "phase"):
        return math.radians(value) / (2 if name == "half_gap" else 1)
    return float(value)
