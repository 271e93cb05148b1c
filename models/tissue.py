"""The tissue: the laws that resist the inserted shaft, per mm of shaft.

Friction acts at the interface between shaft and tissue, against their slip s:

    viscous s (s^2 + plateau^2)^((exponent-1)/2)     viscous, or a power law above a plateau
    dry level [kinetic + (static - kinetic) exp(-(s/stribeck)^2)], truly sticking
    shared s / sqrt(s^2 + (q v/r)^2)                  dry, shared with axial speed v, of which q counts

and the tissue at the shaft may itself turn, by phi, against a Kelvin-Voigt element
stiffness phi + stiffness time_constant dphi/dt (Section IV-A2).

Four more factors may shape a law: a curve of |s| on the viscous torque, a different strength in
either direction, a factor that varies in time, and one of what the contact has been through. A
torque may also depend on the shaft's angle: of a bent shaft, and of one that is not round,

    orientation sin(cycles theta - phase)
    orientation_viscous s cos(cycles theta - phase)
    orientation_dry (1 + cos(cycles theta - phase))       more of the dry level.
"""

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from models.contact import ContactCurve
from models.errors import InvalidValue
from models.kerf import Kerf
from models.needle import NonNegative, Positive
from models.record import Record

Array = NDArray[np.float64]

RATE_POINTS = 23
"""Of a curve over the rate, at most."""
THINNEST_MM = 1e-3
"""A layer into which the tip reaches less far is not met."""


class Interface(Record):
    """The law of one kind of tissue, per mm of shaft."""

    viscous_n_mm_s_per_mm: NonNegative = 0.0
    """At 1 rad/s, N mm s / rad per mm."""
    exponent: Positive = 1.0
    plateau_rad_s: Positive = 1e-5
    """Rate below which a power law is viscous again: no fluid's viscosity is infinite at rest."""
    kinetic_n_mm_per_mm: NonNegative = 0.0
    static_n_mm_per_mm: NonNegative | None = None
    """None: as kinetic."""
    stribeck_rad_s: Positive | None = None
    shared_n_mm_per_mm: NonNegative = 0.0
    shared_axial_ratio: NonNegative = 1.0
    """Share q of the axial speed: 1 by physics; less where a twist is released over a longer travel."""
    stiffness_n_mm_per_rad_per_mm: Positive | None = None
    """None: tissue that does not yield."""
    time_constant_s: NonNegative = 0.0
    viscosity_exponent: float = Field(default=1.0, ge=0, le=1)
    """Power of a factor of its stiffness alone by which its own viscosity goes along; 0: that stays."""
    flows_at_deg: Positive | None = None
    """Twist of the tissue beyond which it flows, so that it does not turn back; None: it is elastic."""
    dragged_ratio: float = Field(default=0.0, ge=0, le=1)
    """Share of the shaft's axial motion by which its twist goes along; 0: the tissue stays."""
    orientation_n_mm_per_mm: NonNegative = 0.0
    orientation_viscous_n_mm_s_per_mm: NonNegative = 0.0
    """At 1 rad/s, N mm s / rad per mm; beside at least as much viscous torque, it damps at any angle."""
    orientation_dry_n_mm_per_mm: NonNegative = 0.0
    orientation_phase_deg: float = 0.0
    orientation_cycles: Positive = 1.0
    """In one turn of the shaft."""
    asymmetry: float = Field(default=0.0, gt=-1, lt=1)
    """Torque against positive rates: 1 + asymmetry times; against negative ones: 1 - asymmetry times."""
    varies: bool = False
    """Whether the torque, and the stiffness, are times the `tissue_factor` of the schedule."""
    stiffness_varies: bool = False
    """Whether the stiffness alone is."""
    rate_curve: tuple[Positive, ...] = ()
    """Factors of the viscous torque at 2 to `RATE_POINTS` rates, evenly spaced in their logarithm."""
    rate_range_rad_s: tuple[Positive, Positive] = (0.01, 10.0)
    """Lowest and highest rate of the curve, which is level beyond them."""
    contact: ContactCurve | None = None
    """Factors on the torque over what the contact has been through; None: it is 1."""

    @model_validator(mode="after")
    def _curve_is_complete(self) -> "Interface":
        if self.rate_curve and not 2 <= len(self.rate_curve) <= RATE_POINTS:
            expected = f"2 to {RATE_POINTS} factors, or none"
            raise InvalidValue("rate_curve", len(self.rate_curve), expected)
        low, high = self.rate_range_rad_s
        if low >= high:
            raise InvalidValue("rate_range_rad_s", (low, high), "a lower rate, then a higher one")
        return self

    @model_validator(mode="after")
    def _static_is_a_peak(self) -> "Interface":
        static = self.static_level_n_mm_per_mm
        if static < self.kinetic_n_mm_per_mm:
            raise InvalidValue(
                "static_n_mm_per_mm", static, f"at least the kinetic level {self.kinetic_n_mm_per_mm}"
            )
        if static > self.kinetic_n_mm_per_mm and self.stribeck_rad_s is None:
            raise InvalidValue(
                "stribeck_rad_s", None, "a rate in rad/s, because static exceeds kinetic friction"
            )
        return self

    @property
    def static_level_n_mm_per_mm(self) -> float:
        """The dry level at rest."""
        return self.kinetic_n_mm_per_mm if self.static_n_mm_per_mm is None else self.static_n_mm_per_mm


class Layer(Record):
    """A layer of tissue; it begins where the previous layer ends."""

    interface: Interface
    thickness_mm: Positive | None = None
    """Depth that this layer takes; None: all the rest."""
    fraction: float | None = Field(default=None, gt=0, lt=1)
    """Or its share of the inserted length."""

    @model_validator(mode="after")
    def _one_measure(self) -> "Layer":
        if self.thickness_mm is not None and self.fraction is not None:
            raise InvalidValue("fraction", self.fraction, "either thickness_mm or fraction, not both")
        return self


class Section(Record):
    """A section of the shaft with a law of its own, as far as it is inserted: a worn coating, say."""

    interface: Interface
    from_tip_mm: NonNegative
    """Its end towards the tip."""
    length_mm: Positive


class Tissue(Record):
    """Layers along the depth, and the friction where the shaft enters."""

    name: str = "custom"
    layers: tuple[Layer, ...] = Field(min_length=1)
    entry_friction_n_mm: NonNegative = 0.0
    """Dry torque in one place, where the shaft enters."""
    throughout: tuple[Interface, ...] = ()
    """Further laws over the whole inserted length."""
    sections: tuple[Section, ...] = ()
    """Further laws of sections of the shaft."""
    at_tip: tuple[Interface, ...] = ()
    """Laws in one place, at the tip: their torques are N mm in place of N mm per mm."""
    at_entry: tuple[Interface, ...] = ()
    """The same where the shaft enters."""
    kerfs: tuple[Kerf, ...] = ()
    """What holds the tip in the slit that it has cut."""
    unknown: tuple[str, ...] = ()
    """What the source does not state of this tissue, and what is assumed instead."""

    @model_validator(mode="after")
    def _only_the_last_layer_is_open(self) -> "Tissue":
        for i, layer in enumerate(self.layers[:-1]):
            if layer.thickness_mm is None and layer.fraction is None:
                raise InvalidValue(f"layers.{i}.thickness_mm", None, "a thickness, or a fraction")
        last = self.layers[-1]
        if last.thickness_mm is not None or last.fraction is not None:
            raise InvalidValue(
                f"layers.{len(self.layers) - 1}.thickness_mm",
                last.thickness_mm or last.fraction,
                "no thickness: the last layer takes the rest",
            )
        return self

    def boundaries_mm(self, inserted_mm: float) -> Array:
        """Where layers begin and end within an inserted length, mm, both ends included.

        A boundary less than `THINNEST_MM` from the tip is left out.
        """
        places, depth = [0.0], 0.0
        for layer in self.layers[:-1]:
            depth += layer.thickness_mm or (layer.fraction or 0.0) * inserted_mm
            places.append(depth)
        inside = places[:1] + [at for at in places[1:] if at < inserted_mm - THINNEST_MM]
        return np.array([*inside, inserted_mm])

    @classmethod
    def uniform(
        cls, *, name: str = "custom", entry_friction_n_mm: float = 0.0, **law: float
    ) -> "Tissue":
        """Tissue of one layer; the keyword arguments `law` are fields of `Interface`."""
        return cls(
            name=name,
            layers=(Layer(interface=Interface(**law)),),
            entry_friction_n_mm=entry_friction_n_mm,
        )
