"""How long the nominal needle remembers: the time constants of its modes."""

from diagnosis.log.nominal_rig import NominalRig
from models.modes import InsertedNeedle
from models.needle import Needle

_LEAST_INSERTED_MM = 1.0  # a tip outside of the tissue has no modes


def time_constant_s(rig: NominalRig, inserted_mm: float, free_mm: float, *, mode: int) -> float:
    """Time in which a mode of the nominal needle decays to 37 %, s; the slowest is mode 1."""
    held = InsertedNeedle(
        needle=Needle(**dict(rig.needle)),
        damping_n_mm_s_per_mm=rig.tissue.damping_n_mm_s_per_mm,
        inserted_mm=max(inserted_mm, _LEAST_INSERTED_MM),
        free_mm=max(free_mm, 0.0),  # the stage's reading scatters about 0
    )
    return 1.0 / abs(float(held.poles_rad_s(mode)[mode - 1]))
