"""The paper's five materials (Table I), as far as it states them, and plastisol that only damps.

Constants that follow from printed figures are computed here, once. Constants that the paper does
not state are listed, together with the values that are used instead.
"""

import numpy as np

from models import published
from models.errors import UnknownName
from models.lag import level_n_mm_per_mm
from models.needle import NITINOL
from models.tissue import Tissue


def slope_per_mm(by_depth_cm: dict[float, float]) -> float:
    """Least squares line through the origin of Table II, per mm of depth."""
    depth = np.array(list(by_depth_cm)) * 10
    torque = np.array(list(by_depth_cm.values()))
    return float(depth @ torque / (depth @ depth))


def tissue_stiffness_n_mm_per_rad_per_mm() -> float:
    """k_t of (27)-(29) for 1 mm of the paper's shaft: G_t A r^2 / h."""
    shear_kpa = published.TISSUE_MODULUS.value / (2 * (1 + published.TISSUE_POISSON.value))
    area_mm2 = published.ELEMENT_AREA.value
    return shear_kpa * 1e-3 * area_mm2 * NITINOL.radius_mm**2 / published.TISSUE_DEPTH.value


def tissue_time_constant_s() -> float:
    """tau = b_t / k_t of the printed element. (The paper's (30) has it upside down.)"""
    return published.TISSUE_DAMPER.value / published.TISSUE_SPRING.value


_DAMPING = slope_per_mm(dict(published.DAMPING_PLASTISOL_N_MM_S))
_GELATIN_LEVEL = slope_per_mm(dict(published.STATIC_TORQUE_GELATIN_N_MM))
_STIFFNESS = tissue_stiffness_n_mm_per_rad_per_mm()
_TIME = tissue_time_constant_s()
_HARD = published.HARD_OVER_SOFT.value

# Non-translating experiments: 23 cm between base and tissue, 10 cm inserted.
_FREE_MM, _DEPTH_MM = 230.0, 100.0
_SIMTEST_LEVEL = published.SIMTEST_TORQUE.value / _DEPTH_MM
_CHICKEN_LEVEL = level_n_mm_per_mm(
    NITINOL, lag_deg=published.CHICKEN_LAG.value, free_mm=_FREE_MM, inserted_mm=_DEPTH_MM
)

_NO_ELASTICITY = "elasticity, and therefore creep: none is used"
_NO_VISCOUS = "viscous damping: none is used"

MATERIALS: dict[str, Tissue] = {
    tissue.name: tissue
    for tissue in (
        Tissue.uniform(
            name="soft-plastisol",
            viscous_n_mm_s_per_mm=_DAMPING,
            stiffness_n_mm_per_rad_per_mm=_STIFFNESS,
            time_constant_s=_TIME,
        ).but(unknown=("dry friction at rest: none is used",)),
        Tissue.uniform(
            name="hard-plastisol",
            viscous_n_mm_s_per_mm=_DAMPING,
            stiffness_n_mm_per_rad_per_mm=_STIFFNESS * _HARD,
            time_constant_s=_TIME,
        ).but(
            unknown=(
                "damping: Table II does not say which plastisol was measured",
                "elasticity: 100 times that of the soft one is used, as in Section IV-B",
            )
        ),
        Tissue.uniform(name="viscous-plastisol", viscous_n_mm_s_per_mm=_DAMPING).but(
            unknown=("motion of the tissue: the model of Sections III and V has none",)
        ),
        Tissue.uniform(name="porcine-gelatin", shared_n_mm_per_mm=_GELATIN_LEVEL).but(
            unknown=(_NO_VISCOUS, _NO_ELASTICITY)
        ),
        Tissue.uniform(name="simtest", shared_n_mm_per_mm=_SIMTEST_LEVEL).but(
            unknown=(
                "friction against depth: the one torque of Section II-D is used, spread over 10 cm",
                _NO_VISCOUS,
                _NO_ELASTICITY,
            )
        ),
        Tissue.uniform(name="chicken", shared_n_mm_per_mm=_CHICKEN_LEVEL).but(
            unknown=(
                "friction: calculated with eq. (2) from a lag of 3 deg at 10 cm",
                _NO_VISCOUS,
                _NO_ELASTICITY,
            )
        ),
    )
}


def tissue_named(name: str) -> Tissue:
    """A tissue by name.

    Raises:
      UnknownName: lists the known names.
    """
    if name not in MATERIALS:
        raise UnknownName("tissue", name, MATERIALS)
    return MATERIALS[name]
