"""A shaft heavier than any material: the inertia of a machine told as a shaft, or another unit.

A machine that is not a needle is told by similarity, as an equivalent shaft whose density carries the
inertia. One as stiff as a metal, whose density is that of a material in kg/m3, is a needle in another
unit.
"""

from pathlib import Path

from diagnosis.criteria.log import LEAST_MATERIAL_GPA, MATERIALS_KG_M3
from diagnosis.log.nominal_rig import NominalNeedle
from diagnosis.log.trial import UnusableLog
from models.needle import DENSEST_G_CM3


def refuse_kg_m3(path: Path, needle: NominalNeedle) -> None:
    """Refuse a density in kg/m3.

    Raises:
      UnusableLog: names the file, the field and the fix.
    """
    low, high = MATERIALS_KG_M3
    if needle.shear_modulus_gpa >= LEAST_MATERIAL_GPA and low <= needle.density_g_cm3 <= high:
        raise UnusableLog(
            f"{path}: needle.density_g_cm3: expected 0.1 to {DENSEST_G_CM3:g} of a shaft with a shear "
            f"modulus of {needle.shear_modulus_gpa:g} GPa, found {needle.density_g_cm3:g}; if it is in "
            "kg/m3, divide it by 1000"
        )


def heavy_shaft_warnings(needle: NominalNeedle) -> list[str]:
    """A warning, where a shaft is heavier than any material."""
    if needle.density_g_cm3 <= DENSEST_G_CM3:
        return []
    return [
        f"rig.yaml: density_g_cm3 is {needle.density_g_cm3:.6g}, more than that of any material; it is "
        "taken for the inertia of a machine, spread over the shaft"
    ]
