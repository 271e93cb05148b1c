"""Names in another spelling or unit than that of the format, and how to fix them.

`Tip Angle [rad]` is not read as `tip_angle_deg`: a unit is never guessed. But the error says
that the two are similar, and by which factor to multiply.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import SequenceMatcher

from diagnosis.criteria.checks import NOISE_RATIO
from diagnosis.criteria.log import NAME_LIKENESS

# How many of the format's unit one of these is. `mN m`, `mNm` and `mn_m` are all "mnm" here.
ANGLES = {"deg": 1, "degree": 1, "degrees": 1, "rad": 57.29578, "radian": 57.29578}
ANGLES |= {"radians": 57.29578, "mrad": 0.05729578, "rev": 360, "turn": 360, "turns": 360}
TIMES = {"s": 1, "sec": 1, "second": 1, "seconds": 1, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60}
LENGTHS = {"mm": 1, "cm": 10, "m": 1000, "um": 1e-3, "inch": 25.4, "inches": 25.4}
SPEEDS = {"mms": 1, "mmpers": 1, "cms": 10, "ms": 1000, "mpers": 1000, "ums": 1e-3, "mmmin": 1 / 60}
TORQUES = {"nmm": 1, "mnm": 1, "nm": 1000, "ncm": 10, "mnmm": 1e-3, "unm": 1e-3}
_STIFFNESSES = {"gpa": 1, "mpa": 1e-3, "kpa": 1e-6, "pa": 1e-9, "nmm2": 1e-3}
_DENSITIES = {"gcm3": 1, "gpercm3": 1, "kgm3": 1e-3, "kgperm3": 1e-3}
_DAMPINGS = {"nmmspermm": 1, "nmsperm": 1, "ns": 1, "nmmsmm": 1, "nmspermm": 1000, "mnmmspermm": 1e-3}
_UNITS: dict[str, dict[str, float]] = {
    "time_s": TIMES,
    "base_angle_deg": ANGLES,
    "tip_angle_deg": ANGLES,
    "base_torque_n_mm": TORQUES,
    "tip_torque_n_mm": TORQUES,
    "inserted_mm": LENGTHS,
    "free_mm": LENGTHS,
    "speed_mm_s": SPEEDS,
    "diameter_mm": LENGTHS,
    "shear_modulus_gpa": _STIFFNESSES,
    "density_g_cm3": _DENSITIES,
    "damping_n_mm_s_per_mm": _DAMPINGS,
    "tip_angle_noise_deg": ANGLES,
    "base_torque_noise_n_mm": TORQUES,
    "base_angle_noise_deg": ANGLES,
}
# Units that a log may be in as a whole, as they are written.
_WHOLE: dict[str, dict[str, float]] = {
    "deg": {"rad": 57.29578, "mrad": 0.05729578, "revolutions": 360},
    "n_mm": {"N m": 1000, "N cm": 10, "mN mm": 1e-3},
}
_ANY_UNIT = {unit for units in _UNITS.values() for unit in units}


@dataclass(frozen=True, kw_only=True)
class OtherUnit:
    """A unit that a column may be in, and its size in the column's own unit."""

    name: str
    factor: float

    @property
    def fix(self) -> str:
        """What to do, as an instruction."""
        return f"multiply it by {self.factor:.6g}"


@dataclass(frozen=True, kw_only=True)
class LookAlike:
    """A name that was found where another was expected.

    Attributes:
      found, wanted: the two names.
      factor: factor by which the found values have to be multiplied; None: no unit is named.
      likeness: similarity of the quantities' names, 0 to 1.
    """

    found: str
    wanted: str
    factor: float | None
    likeness: float

    @property
    def fix(self) -> str:
        """What to do, as an instruction."""
        if self.factor is None:
            return "bring it to the unit in that name and rename it"
        return "rename it" if self.factor == 1 else f"multiply it by {self.factor:g} and rename it"


def look_alike(found: Iterable[str], wanted: str, known: Iterable[str]) -> LookAlike | None:
    """The name that is most similar to the wanted one, and to no other known name more; None: none."""
    rivals = [name for name in known if name != wanted]
    alike = [_compared(name, wanted) for name in found]
    own = [
        one
        for one in alike
        if one.likeness >= NAME_LIKENESS
        and all(_compared(one.found, rival).likeness <= one.likeness for rival in rivals)
    ]
    return max(own, key=lambda one: one.likeness, default=None)


def unit_off_by(column: str, factor: float) -> OtherUnit | None:
    """The unit in which the readings of a column would be smaller by about this factor; None: none."""
    low, high = NOISE_RATIO
    units = _WHOLE["deg"] if column.endswith("_deg") else _WHOLE["n_mm"]
    near = [OtherUnit(name=name, factor=own) for name, own in units.items() if low < factor / own < high]
    return near[0] if near else None


def _compared(found: str, wanted: str) -> LookAlike:
    words, (quantity, _) = words_of(found), _without_unit(words_of(wanted), _UNITS[wanted])
    stem, factor = _without_unit(words, _UNITS[wanted])
    foreign = factor is None and bool(_without_unit(words, dict.fromkeys(_ANY_UNIT, 1.0))[1])
    likeness = 0.0 if foreign else _likeness(stem, quantity)
    return LookAlike(found=found, wanted=wanted, factor=factor, likeness=likeness)


def words_of(name: str) -> list[str]:
    """`Base Torque [mN·m]` and `baseTorque_mN_m` are both base, torque, m, n, m or mn, m."""
    plain = name.replace("°", " deg").replace("µ", "u").replace("μ", "u").replace("^", "")
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z][a-z])", "_", plain)
    return re.findall(r"[a-z0-9]+", spaced.lower())


def _without_unit(words: list[str], units: dict[str, float]) -> tuple[list[str], float | None]:
    """The quantity, and the factor of the longest unit that the name ends with."""
    for first in range(len(words)):
        unit = "".join(words[first:])
        if unit in units:
            return words[:first], units[unit]
    return words, None


def _likeness(found: list[str], wanted: list[str]) -> float:
    if found and set(found) < set(wanted):
        return 0.9
    if set(found) == set(wanted):
        return 1.0
    return SequenceMatcher(None, "".join(found), "".join(wanted)).ratio()
