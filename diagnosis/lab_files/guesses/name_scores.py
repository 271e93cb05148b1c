"""How well a lab's name fits a column of rig-log/1: weights of its words, for it and against it.

Words count for or against a match; a unit of the right quantity counts for it.
"""

import re
from collections.abc import Mapping, Sequence

import numpy as np

from diagnosis.criteria.lab_files import NAME_LEAST_SCORE
from diagnosis.lab_files.readers.lab_table import Array, LabTable
from diagnosis.lab_files.units import (
    QUANTITIES,
    MeasuredQuantity,
    factor_of,
    is_of_counts,
    unit_in,
    without_unit,
)
from diagnosis.log.unit_hints import words_of

# A star stands for any end of a word; numbers at the end do not count.
BASE = (
    "base motor mot surf* drive* driven input chuck hub prox* crank* shaft spindle enc* actuator antrieb"
)
TIP = "tip distal spitze cam camera* marker* tracker* em output bevel aurora needletip bit"
_ANGLE = "ang* theta phi rot* pos* winkel disp* turn* roll q orient* enc*"
_TURN = "ang* theta phi rot* winkel turn* roll orient*"
RATE = "vel* rate omega speed* rpm gyro* acc* dot v"
COMMANDED = "set setpoint ref reference cmd command* desired target soll des"
_OTHER = "err error* cov* temp* current* volt* status index seq sample* frame"
_TORQUE = {"torq*": 4, "moment*": 4, "tau": 4, "trq": 4, "mz": 4, "tz": 3, "effort": 3, "drehm*": 4}
_TORQUE |= {"force*": 2, "load": 2}
_DEPTH = {"insert*": 4, "depth": 4, "penetr*": 4, "tiefe": 4, "stage": 2, "axial": 2, "linear": 2}
_DEPTH |= {"carriage": 2, "z": 3}
_SPEED = {"speed*": 3, "vel*": 3, "feed": 2, "v": 2}
_NONE = -100.0
_AXIS = re.compile(r"(?<![A-Za-z])[xyzwXYZW]$")
_VOLTS = re.compile(r"(?<![A-Za-z])V(?![A-Za-z])")


def is_called_an_angle(table: LabTable, name: str) -> bool:
    """Whether a column is called an angle that was measured, in no unit of anything else."""
    unit = unit_in(name)
    known = [quantity for quantity in MeasuredQuantity if factor_of(unit, quantity) is not None]
    foreign = bool(known) and MeasuredQuantity.ANGLE not in known
    wanted = not has_word(all_words(table, name), COMMANDED)
    return wanted and not foreign and score_of("base_angle_deg", table, name) >= NAME_LEAST_SCORE


def has_word(words: Sequence[str], stems: str) -> bool:
    """Whether any word is one of these stems."""
    return any(_matches(word, stem) for word in words for stem in stems.split())


def weight_of(words: Sequence[str], weights: Mapping[str, float]) -> float:
    """The largest weight of a stem among these words."""
    return max((weight for stem, weight in weights.items() if has_word(words, stem)), default=0.0)


def score_of(wanted: str, table: LabTable, name: str) -> float:
    """Score of a name and its unit: weights of words for it, 2 for a unit, minus words against it."""
    words, unit = all_words(table, name), unit_in(name)
    known = [quantity for quantity in MeasuredQuantity if factor_of(unit, quantity) is not None]
    foreign = bool(known) and QUANTITIES[wanted] not in known
    base, tip = 2.0 * has_word(words, BASE), 2.0 * has_word(words, TIP)
    rate = has_word(words, RATE) or MeasuredQuantity.ANGULAR_RATE in known
    place, quaternion = _is_place(table, name, words), "w" in _axes_of(table, name)
    angle = 2.0 * (has_word(words, _ANGLE) or is_of_counts(unit))
    torque, depth = weight_of(words, _TORQUE), weight_of(words, _DEPTH)
    still = 3.0 * (span_of(table.columns[name]) == 0)
    # A linear rig has lengths for angles and forces for torques: asked, but not ruled out.
    linear = wanted in ("base_angle_deg", "base_torque_n_mm")
    fits, weight = {
        "base_angle_deg": (
            angle + base > 0 and not (tip or rate or torque or depth or place),
            angle + base - still,
        ),
        "tip_angle_deg": (tip > 0 and not (rate or torque or place), angle + tip),
        "base_torque_n_mm": (torque > 0 and not tip, torque + base / 2 + ("z" in words)),
        "tip_torque_n_mm": (torque > 0 and tip > 0, torque + tip),
        "inserted_mm": (depth > 0 and not (rate or torque or tip or has_word(words, "free")), depth),
        "free_mm": (has_word(words, "free") and not rate, 3.0),
        "speed_mm_s": (rate and not (tip or base), weight_of(words, _SPEED)),
    }[wanted]
    if not fits or quaternion or (foreign and not linear):
        return _NONE
    unit_weight = 2.0 if known and not foreign else 0.0
    against = 2.0 * has_word(words, COMMANDED) + 5.0 * has_word(words, _OTHER)
    return weight + unit_weight - against


def _is_place(table: LabTable, name: str, words: Sequence[str]) -> bool:
    """Whether a column is one of several coordinates of a place: a length, whatever it is a place of."""
    return bool(_axes_of(table, name)) and not has_word(words, _TURN)


def _axes_of(table: LabTable, name: str) -> set[str]:
    """Axes beside which a column stands for one: x, y, z and w of a quaternion; empty without others."""
    own = without_unit(name).strip()
    if not _AXIS.search(own):
        return set()
    plain = {without_unit(other).strip() for other in table.columns}
    axes = {axis for axis in "xyzwXYZW" if own[:-1] + axis in plain}
    return {axis.lower() for axis in axes} if len(axes) > 1 else set()


def all_words(table: LabTable, name: str) -> list[str]:
    """Words of a name and of its joint; a capital V is volts, unless its unit is that of a speed."""
    plain = without_unit(name)
    if not factor_of(unit_in(name), MeasuredQuantity.SPEED):
        plain = _VOLTS.sub(" ", plain)
    return [*words_of(plain), *words_of(table.words.get(name, ""))]


def _matches(word: str, stem: str) -> bool:
    return word.startswith(stem[:-1]) if stem.endswith("*") else word.rstrip("0123456789") == stem


def span_of(values: Array) -> float:
    """Largest minus smallest value."""
    finite = values[np.isfinite(values)]
    return float(np.ptp(finite)) if finite.size else 0.0
