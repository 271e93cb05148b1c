"""The needle: a round wire in torsion.

Polar moment J = pi d^4 / 32, torsional rigidity kappa = J G, rotary inertia per
length eta = rho J (Section II-A and below (4) of Reed, Okamura and Cowan 2009).
"""

import math
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from models import units
from models.errors import InvalidValue, UnknownName
from models.record import Record

Positive = Annotated[float, Field(gt=0)]
NonNegative = Annotated[float, Field(ge=0)]

DENSEST_G_CM3 = 30.0
"""No material is denser; a denser shaft stands for the inertia of a machine."""
STIFFNESS_POINTS = 12
"""Of a curve of the stiffness over the torque."""


class Needle(Record):
    """Material and shape of a needle, and the torques that depend on it alone.

    All fields after the length are neutral by default: the straight, bare shaft of the paper.
    """

    name: str = "custom"
    diameter_mm: Annotated[float, Field(gt=0, le=100)]
    shear_modulus_gpa: Positive
    density_g_cm3: Annotated[float, Field(gt=0, le=1e9)]
    length_mm: Annotated[float, Field(gt=0, le=5000)] = 410.0
    """From the chuck to the tip."""
    tip_drag_n_mm_s_per_rad: NonNegative = 0.0
    """Viscous torque in one place, at the tip."""
    curvature_n_mm_per_mm: NonNegative = 0.0
    """A bent shaft prefers one orientation: torque sin(theta - phase) per mm inserted."""
    curvature_phase_deg: float = 0.0
    load_coefficient: NonNegative = 0.0
    """Dry torque at the tip over the torque that the tip carries."""
    tip_inertia_kg_m2: NonNegative = 0.0
    """Of what is fixed to the tip, about the axis."""
    stiffness_curve: tuple[Positive, ...] = ()
    """Factors of the torsional stiffness at `STIFFNESS_POINTS` torques from 0, as squares, first of
    negative ones, then of positive ones; none: it is 1."""
    stiffness_torque_n_mm: NonNegative = 0.0
    """At the last of either. Torques are what the nominal stiffness would carry at the same twist; the
    curve is level beyond them."""
    stiffness_along: tuple[Positive, ...] = ()
    """Factors of the torsional stiffness at even places from the tip on, straight between them and level
    beyond; none: it is 1."""
    stiffness_along_mm: NonNegative = 0.0
    """From the tip to the last of these."""
    yield_torque_n_mm: Positive | None = None
    """Beyond which the shaft twists plastically, either way; None: it is elastic."""
    yield_stiffness_ratio: Annotated[float, Field(ge=0, lt=1)] = 0.0
    """Stiffness beyond it over the elastic one: linear kinematic hardening."""
    creep_ratio: NonNegative = 0.0
    """Twist that a torque adds in time, over the elastic one: a standard linear solid."""
    creep_time_s: NonNegative = 0.0
    """In which 63 % of it come."""
    damping_time_s: NonNegative = 0.0
    """Damping of its material over its stiffness: a Kelvin-Voigt solid."""
    joint_play_deg: NonNegative = 0.0
    """Total play of a joint in the shaft; 0: there is none."""
    joint_length_mm: NonNegative = 0.0
    """Shaft that twists as much as the joint, a torsion spring of kappa over this; 0: it is stiff."""
    joint_from_tip_mm: NonNegative = 0.0
    """Where the joint is."""

    @model_validator(mode="after")
    def _curve_is_complete(self) -> "Needle":
        if len(self.stiffness_curve) not in (0, 2 * STIFFNESS_POINTS):
            raise InvalidValue(
                "stiffness_curve", len(self.stiffness_curve), f"{2 * STIFFNESS_POINTS} factors, or none"
            )
        if self.stiffness_curve and self.stiffness_torque_n_mm == 0.0:
            raise InvalidValue("stiffness_torque_n_mm", 0.0, "a torque above 0 where there is a curve")
        if self.stiffness_along and self.stiffness_along_mm == 0.0:
            raise InvalidValue("stiffness_along_mm", 0.0, "a length above 0 where there are factors")
        if self.creep_ratio and self.creep_time_s == 0.0:
            raise InvalidValue("creep_time_s", 0.0, "a time above 0 of a shaft that creeps")
        if self.creep_ratio and self.yield_torque_n_mm is not None:
            raise InvalidValue("creep_ratio", self.creep_ratio, "0 of a shaft that yields")
        if self.joint_play_deg and (self.creep_ratio or self.yield_torque_n_mm is not None):
            raise InvalidValue(
                "joint_play_deg", self.joint_play_deg, "0 of a shaft that yields or creeps"
            )
        return self

    @property
    def polar_moment_mm4(self) -> float:
        """J, mm^4."""
        return math.pi * self.diameter_mm**4 / 32

    @property
    def rigidity_n_mm2(self) -> float:
        """kappa = J G, N mm^2: torque over twist per length."""
        return self.polar_moment_mm4 * self.shear_modulus_gpa * units.GPA_TO_N_PER_MM2

    def stiffness_factors(self, from_tip_mm: NDArray[np.float64]) -> NDArray[np.float64]:
        """Of the stiffness at distances from the tip, (n,)."""
        if not self.stiffness_along:
            return np.ones(from_tip_mm.shape)
        places = np.linspace(0.0, self.stiffness_along_mm, len(self.stiffness_along))
        return np.interp(from_tip_mm, places, self.stiffness_along)

    @property
    def rotary_inertia_kg_m(self) -> float:
        """eta = rho J, kg m: moment of inertia about the axis, per length."""
        return self.density_g_cm3 * units.G_PER_CM3 * self.polar_moment_mm4 * units.MM**4

    @property
    def wave_speed_m_s(self) -> float:
        """Speed of torsional waves, sqrt(kappa / eta) = sqrt(G / rho), m/s."""
        return math.sqrt(self.rigidity_n_mm2 * units.N_MM2 / self.rotary_inertia_kg_m)

    @property
    def mass_kg_per_m(self) -> float:
        """rho A, kg/m."""
        area = math.pi / 4 * (self.diameter_mm * units.MM) ** 2
        return self.density_g_cm3 * units.G_PER_CM3 * area

    @property
    def radius_mm(self) -> float:
        """Half of the diameter, mm."""
        return self.diameter_mm / 2

    def shear_stress_mpa(self, torque_n_mm: float) -> float:
        """Largest shear stress in the round shaft, at its surface: 16 T / (pi d^3), MPa."""
        return 16 * torque_n_mm / (math.pi * self.diameter_mm**3)

    def torque_n_mm_at(self, shear_stress_mpa: float) -> float:
        """The torque of a shear stress at the surface, N mm."""
        return shear_stress_mpa * math.pi * self.diameter_mm**3 / 16


# Section II-A: solid Nitinol wire. Its G is the paper's own measurement.
NITINOL = Needle(name="nitinol-0.59", diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45)

# Section II-D compares with the 1.27 mm needles of prostate brachytherapy: the same
# diameter in the paper's Nitinol and in steel (G and density of austenitic steel).
NEEDLES: dict[str, Needle] = {
    needle.name: needle
    for needle in (
        NITINOL,
        NITINOL.but(name="nitinol-1.27", diameter_mm=1.27),
        Needle(name="steel-1.27", diameter_mm=1.27, shear_modulus_gpa=77.0, density_g_cm3=7.9),
    )
}


def needle_named(name: str) -> Needle:
    """A needle by name.

    Raises:
      UnknownName: lists the known names.
    """
    if name not in NEEDLES:
        raise UnknownName("needle", name, NEEDLES)
    return NEEDLES[name]
