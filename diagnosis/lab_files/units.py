"""Units that labs use, as multiples of those of rig-log/1: deg, deg/s, N mm, mm, mm/s, s.

A unit is written in many ways: `N·mm`, `N mm`, `Nmm` and `[n_mm]` are the same. Only letters and digits
count, in lower case. The same letters may be two units (`ms` is a millisecond, `m/s` a speed): the
quantity of the column decides.
"""

import math
import re
from enum import StrEnum

from diagnosis.log.unit_hints import ANGLES, LENGTHS, SPEEDS, TIMES, TORQUES


class MeasuredQuantity(StrEnum):
    """The quantity of a column; its value is the unit in rig-log/1."""

    ANGLE = "deg"
    ANGULAR_RATE = "deg/s"
    TORQUE = "N mm"
    LENGTH = "mm"
    SPEED = "mm/s"
    TIME = "s"


QUANTITIES = {
    "time_s": MeasuredQuantity.TIME,
    "base_angle_deg": MeasuredQuantity.ANGLE,
    "tip_angle_deg": MeasuredQuantity.ANGLE,
    "base_torque_n_mm": MeasuredQuantity.TORQUE,
    "tip_torque_n_mm": MeasuredQuantity.TORQUE,
    "inserted_mm": MeasuredQuantity.LENGTH,
    "free_mm": MeasuredQuantity.LENGTH,
    "speed_mm_s": MeasuredQuantity.SPEED,
}
"""By column of rig-log/1."""
RATES = {
    MeasuredQuantity.ANGLE: MeasuredQuantity.ANGULAR_RATE,
    MeasuredQuantity.LENGTH: MeasuredQuantity.SPEED,
}
"""What is integrated to give a quantity."""

_RAD = 180 / math.pi
_POUND_INCH = 112.98482902761668
_INCH, _FOOT = 25.4, 304.8
_ANGLES = ANGLES | {"rad": _RAD, "radian": _RAD, "radians": _RAD, "mrad": _RAD / 1000, "grad": 0.9}
_ANGLES |= {"gon": 0.9, "revolution": 360, "revolutions": 360, "rot": 360}
_ANGLES |= {"arcmin": 1 / 60, "arcsec": 1 / 3600}
_TIMES = TIMES | {"msec": 1e-3, "usec": 1e-6, "nsec": 1e-9, "minutes": 60, "h": 3600}
_LENGTHS = LENGTHS | {"in": _INCH, "ft": _FOOT, "mil": 0.0254, "thou": 0.0254}
_SPEEDS = SPEEDS | {"ins": _INCH, "inpers": _INCH, "inchs": _INCH, "inmin": _INCH / 60}
_SPEEDS |= {"mmsec": 1, "msec": 1000, "cmmin": 1 / 6, "fts": _FOOT, "mms1": 1, "ms1": 1000}
_RATES = {"degs": 1, "degsec": 1, "degpers": 1, "dps": 1, "rads": _RAD, "radsec": _RAD, "rpm": 6}
_RATES |= {"radpers": _RAD, "revs": 360, "revmin": 6, "rps": 360, "turnss": 360, "degmin": 1 / 60}
_RATES |= {"rads1": _RAD, "degs1": 1, "mrads": _RAD / 1000, "1min": 6}
_TORQUES = TORQUES | {"knm": 1e6, "knmm": 1e3, "kgfcm": 98.0665, "kgcm": 98.0665, "kgfm": 9806.65}
_TORQUES |= {"gfcm": 0.0980665, "gcm": 0.0980665, "ncm": 10, "newtonmeter": 1000, "newtonmetre": 1000}
for _force, _pounds in (
    ("lb", 1.0),
    ("lbf", 1.0),
    ("lbs", 1.0),
    ("oz", 1 / 16),
    ("ozf", 1 / 16),
    ("kip", 1e3),
):
    for _arm, _inches in (("in", 1.0), ("ft", 12.0)):
        _TORQUES |= dict.fromkeys((_force + _arm, _arm + _force), _POUND_INCH * _pounds * _inches)
UNITS: dict[MeasuredQuantity, dict[str, float]] = {
    MeasuredQuantity.ANGLE: _ANGLES,
    MeasuredQuantity.ANGULAR_RATE: _RATES,
    MeasuredQuantity.TORQUE: _TORQUES,
    MeasuredQuantity.LENGTH: _LENGTHS,
    MeasuredQuantity.SPEED: _SPEEDS,
    MeasuredQuantity.TIME: _TIMES,
}
"""Units of rig-log/1 in one of these, by the letters and digits of its name."""
_BRACKETED = re.compile(r"[\[({<]([^\])}>]*)[\])}>]\W*$")
_COUNTS = {"counts", "count", "cnt", "cnts", "ticks"}
_WITHOUT_SCALE = _COUNTS | {
    "v",
    "mv",
    "kip",
    "kips",
    "lb",
    "lbf",
    "n",
    "kn",
    "a",
    "ma",
}


def factor_of(unit: str, quantity: MeasuredQuantity) -> float | None:
    """Units of rig-log/1 per unit of this name; None: not known for this quantity."""
    return UNITS[quantity].get(_plain(unit))


def is_of_counts(unit: str) -> bool:
    """Whether a unit is counts of an encoder, of which so many are a turn."""
    return _plain(unit) in _COUNTS


def is_unit(text: str) -> bool:
    """Whether a text is a unit of any measured quantity, with or without a known factor."""
    plain = _plain(text)
    return plain in _WITHOUT_SCALE or any(plain in units for units in UNITS.values())


def unit_in(name: str) -> str:
    """The unit at the end of a column's name; empty if there is none.

    `torque [Nm]`, `disp (in)`, `base_angle_rad`, `speed / rpm`.
    """
    bracketed = _BRACKETED.search(name.replace("°", "deg"))
    if bracketed:
        return bracketed[1].strip()
    parts = [part for part in re.split(r"[\s_/,:]+", name.strip()) if part]
    for first in range(1, len(parts)):
        if is_unit(" ".join(parts[first:])):
            return " ".join(parts[first:])
    return ""


def without_unit(name: str) -> str:
    """A column's name without the bracketed unit at its end: that `V` is no velocity."""
    bracketed = _BRACKETED.search(name)
    return name[: bracketed.start()] if bracketed and is_unit(bracketed[1]) else name


def _plain(unit: str) -> str:
    spelled = unit.replace("°", "deg").replace("µ", "u").replace("μ", "u").replace('"', "in")
    return "".join(re.findall(r"[a-z0-9]+", spelled.lower()))
