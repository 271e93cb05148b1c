"""Parts of a free-form law that are so many times as strong."""

from collections.abc import Sequence

from models.contact import ContactCurve
from models.kerf import Kerf
from models.tissue import Interface

_TORQUES = (
    "viscous_n_mm_s_per_mm",
    "kinetic_n_mm_per_mm",
    "shared_n_mm_per_mm",
    "orientation_n_mm_per_mm",
    "orientation_viscous_n_mm_s_per_mm",
    "orientation_dry_n_mm_per_mm",
)


def stronger(law: Interface, strength: float) -> Interface:
    """An additional law with its torques multiplied; so is the stiffness of tissue in series with it."""
    changes = {name: strength * getattr(law, name) for name in _TORQUES}
    if law.stiffness_n_mm_per_rad_per_mm and strength > 0.0:
        changes["stiffness_n_mm_per_rad_per_mm"] = strength * law.stiffness_n_mm_per_rad_per_mm
    changed: Interface = law.but(**changes)
    return changed


def stronger_kerfs(kerfs: Sequence[Kerf], strength: float) -> tuple[Kerf, ...]:
    """Kerfs with their torque multiplied; none at strength 0."""
    if strength == 0.0:
        return ()
    return tuple(kerf.but(torque_n_mm=strength * kerf.torque_n_mm) for kerf in kerfs)


def raised(curve: ContactCurve, strength: float) -> ContactCurve:
    """A curve of factors raised to a power."""
    changed: ContactCurve = curve.but(factors=tuple(factor**strength for factor in curve.factors))
    return changed
