"""Figures printed by Reed, Okamura and Cowan, IEEE Trans. Biomed. Eng. 56 (2009).

Each figure states where it is printed. Nothing is computed here: what follows from these
figures is computed, and compared with them, where it is used.
"""

from dataclasses import dataclass
from types import MappingProxyType

Section = str


@dataclass(frozen=True, kw_only=True)
class PublishedFigure:
    """One printed number.

    Attributes:
      value: as printed.
      unit: as printed, spelled out.
      source: table, figure, equation or section.
      note: a relevant remark of the paper on it, or empty.
    """

    value: float
    unit: str
    source: Section
    note: str = ""


NEEDLE_DIAMETER = PublishedFigure(value=0.59, unit="mm", source="Section II-A")
NEEDLE_SHEAR_MODULUS = PublishedFigure(value=27.2, unit="GPa", source="Section II-A")
NEEDLE_DENSITY = PublishedFigure(value=6.45, unit="g/cm^3", source="Section II-A")
POLAR_MOMENT = PublishedFigure(value=0.012, unit="mm^4", source="Section II-A")
TWIST_TEST_TORQUE = PublishedFigure(
    value=1.24, unit="N mm", source="Section II-A", note="twists 41 cm by 90 deg"
)
TWIST_TEST_LENGTH = PublishedFigure(value=410.0, unit="mm", source="Section II-A")
TWIST_TEST_ANGLE = PublishedFigure(value=90.0, unit="deg", source="Section II-A")

SIMTEST_TORQUE = PublishedFigure(value=1.0, unit="N mm", source="Section II-D")
SIMTEST_LAG = PublishedFigure(value=50.0, unit="deg", source="Section II-D", note="nearly")
FIG_3_PLASTISOL_LAG = PublishedFigure(
    value=10.0, unit="deg", source="Fig. 3", note="about; soft and hard, after the slow turn"
)
CHICKEN_LAG = PublishedFigure(value=3.0, unit="deg", source="Fig. 3")
PODDER_TORQUE = PublishedFigure(value=7.0, unit="N mm", source="Section II-D")
PODDER_LAG = PublishedFigure(value=11.0, unit="deg", source="Section II-D", note="about")
REVERSAL_LEAD = PublishedFigure(
    value=20.0, unit="deg", source="Fig. 4", note="almost; tip rotation before the base overtakes it"
)
FIG_5_SETTLING = PublishedFigure(
    value=2.0, unit="s", source="Fig. 5", note="nearly; the depth is not stated, 20 cm is the largest"
)
SETTLED_WITHIN = PublishedFigure(
    value=3.0, unit="deg", source="Section IV-B", note="of the final base angle"
)

# Table II: depth, cm -> torque.
STATIC_TORQUE_GELATIN_N_MM = MappingProxyType({2.5: 0.17, 5.0: 0.32, 7.5: 0.49, 10.0: 0.58})
DAMPING_PLASTISOL_N_MM_S = MappingProxyType({2.5: 0.37, 5.0: 0.94, 7.5: 1.39, 10.0: 1.63})
TABLE_II_R2_GELATIN = PublishedFigure(value=0.98, unit="-", source="Section II-B2")
TABLE_II_R2_PLASTISOL = PublishedFigure(value=0.97, unit="-", source="Section II-B2")

DAMPING_200_MM = PublishedFigure(value=3.45, unit="N mm s", source="Section IV-A1")

# Table III: dominant eigenvalues for 20 cm, rad/s, and Hankel singular value ratios.
TABLE_III_RAD_S = MappingProxyType(
    {
        "lumped, 64 masses": (0.0, -2.686, -10.74, -24.14, -42.85),
        "lumped, 8 masses": (0.0, -2.652, -10.20, -21.51, -34.84),
        "full modal": (0.0, -2.687, -10.75, -24.18, -42.98),
        "inertialess modal": (0.0, -2.687, -10.75, -24.18, -42.98),
    }
)
TABLE_III_HANKEL = (1.0, 5.396e-1, 7.377e-2, 1.583e-2, 1.710e-3)

TISSUE_MODULUS = PublishedFigure(value=45.2, unit="kPa", source="Section IV-A2")
TISSUE_POISSON = PublishedFigure(value=0.45, unit="-", source="Section IV-A2")
TISSUE_DEPTH = PublishedFigure(
    value=0.5, unit="mm", source="Section IV-A2", note="tissue that turns with the shaft"
)
ELEMENT_AREA = PublishedFigure(value=1.9, unit="mm^2", source="Section IV-A2", note="of 1 mm of shaft")
TISSUE_SPRING = PublishedFigure(value=5.2e-3, unit="N mm/rad", source="(29)", note="per 1 mm element")
TISSUE_DAMPER = PublishedFigure(value=5.4e-3, unit="N mm s/rad", source="Section IV-A2", note="per 1 mm")
HARD_OVER_SOFT = PublishedFigure(value=100.0, unit="-", source="Section IV-B")

FIG_8_SETTLE_SOFT = PublishedFigure(value=1.05, unit="s", source="Section IV-B", note="to within 3 deg")
FIG_8_SETTLE_HARD = PublishedFigure(value=1.22, unit="s", source="Section IV-B", note="to within 3 deg")
FIG_8_INTEGRAL_SOFT = PublishedFigure(value=43.8, unit="s deg", source="Section IV-B")
FIG_8_INTEGRAL_HARD = PublishedFigure(value=48.6, unit="s deg", source="Section IV-B")

# Tables IV and V: depth, cm -> (base only, feedforward, feedback).
TABLE_IV_SETTLE_S = MappingProxyType({5.0: (0.67, 0.46, 0.36), 10.0: (1.02, 0.51, 0.41)})
TABLE_V_INTEGRAL_DEG_S = MappingProxyType({5.0: (27.0, 17.2, 15.3), 10.0: (37.2, 19.0, 16.6)})

FIG_12_BASE_ONLY = PublishedFigure(
    value=12.0, unit="mm", source="Fig. 12", note="out of the plane, four half turns, base alone"
)
FIG_12_COMPENSATED = PublishedFigure(
    value=4.0, unit="mm", source="Fig. 12", note="the same half turns with feedforward compensation"
)
