"""Matches a lab's columns to those of rig-log/1, by the words of their names and their units.

Words count for or against a match; a unit of the right quantity counts for it. A column that is only the
rate of the base's angle is not the axial speed, whatever its name: the data decide.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.criteria import NAME_LEAST_SCORE, SAME_MOTION
from diagnosis.lab_files.readers.lab_table import Array, LabTable
from diagnosis.lab_files.units import QUANTITIES, MeasuredQuantity, factor_of, unit_in, without_unit
from diagnosis.log.unit_hints import words_of

# A star stands for any end of a word; numbers at the end do not count.
_BASE = "base motor drive* driven input chuck hub prox* crank* shaft spindle enc* actuator antrieb"
_TIP = "tip distal spitze cam camera* marker* output bevel aurora needletip"
_ANGLE = "ang* theta phi rot* pos* winkel disp* turn* roll q orient* enc*"
_RATE = "vel* rate omega speed* rpm gyro* acc* dot v"
_COMMANDED = "set setpoint ref reference cmd command* desired target soll des"
_OTHER = "err error* cov* temp* current* volt* status index seq sample* frame"
_TORQUE = {"torq*": 4, "moment*": 4, "tau": 4, "trq": 4, "mz": 4, "tz": 3, "effort": 3, "drehm*": 4}
_TORQUE |= {"force*": 2, "load": 2}
_DEPTH = {"insert*": 4, "depth": 4, "penetr*": 4, "tiefe": 4, "stage": 2, "axial": 2, "linear": 2}
_DEPTH |= {"carriage": 2, "z": 3}
_SPEED = {"speed*": 3, "vel*": 3, "feed": 2, "v": 2}
_NONE = -100.0


@dataclass(frozen=True, kw_only=True)
class NameGuess:
    """A lab's column that matches one of rig-log/1.

    Attributes:
      table: title of its table.
      alike: other columns whose names match equally well.
    """

    wanted: str
    table: LabTable
    column: str
    alike: tuple[str, ...] = ()


def guessed_columns(tables: Sequence[LabTable], taken: Iterable[str]) -> tuple[NameGuess, ...]:
    """The best columns for rig-log/1, each used once.

    Args:
      tables: tables of one trial.
      taken: columns with another use: times, rates of others.
    """
    taken = set(taken)
    scored = [
        (_score(wanted, table, name), _span(table.columns[name]), wanted, table, name)
        for table in tables
        for name in table.columns
        if name not in taken and not name.endswith(".log_time")
        for wanted in QUANTITIES
        if wanted != "time_s"
    ]
    scored = [one for one in scored if one[0] >= NAME_LEAST_SCORE]
    found: list[NameGuess] = []
    for score, _, wanted, table, name in sorted(scored, key=lambda one: one[:2], reverse=True):
        if any(g.wanted == wanted or (g.table is table and g.column == name) for g in found):
            continue
        alike = tuple(n for s, _, w, _, n in scored if w == wanted and n != name and s == score)
        found.append(NameGuess(wanted=wanted, table=table, column=name, alike=alike))
    return tuple(found)


def angular_rate(tables: Sequence[LabTable], used: Iterable[str]) -> tuple[LabTable, str] | None:
    """Table and name of a rate of the base, from which its angle could be integrated; None: none."""
    used = set(used)
    for table in tables:
        for name in table.columns:
            words, unit = _all_words(table, name), unit_in(name)
            turns = factor_of(unit, MeasuredQuantity.ANGULAR_RATE) is not None
            called = (
                has_word(words, _RATE)
                and has_word(words, _BASE)
                and not factor_of(unit, MeasuredQuantity.SPEED)
            )
            if name not in used and (turns or called) and not has_word(words, f"{_TIP} {_COMMANDED}"):
                return table, name
    return None


def is_rate_of(values: Array, time_s: Array, position: Array) -> bool:
    """Whether a column is the rate of another one of the same table, (N,) each."""
    good = np.isfinite(values) & np.isfinite(position) & (np.gradient(time_s) > 0)
    if good.sum() <= 2 or np.ptp(values[good]) == 0 or np.ptp(position[good]) == 0:
        return False
    width = np.ones(5) / 5
    rate = np.convolve(np.gradient(position[good], time_s[good]), width, "same")
    smooth = np.convolve(values[good], width, "same")
    return bool(np.ptp(rate) > 0 and abs(np.corrcoef(smooth, rate)[0, 1]) >= SAME_MOTION)


def has_word(words: Sequence[str], stems: str) -> bool:
    """Whether any word is one of these stems."""
    return any(_matches(word, stem) for word in words for stem in stems.split())


def weight_of(words: Sequence[str], weights: Mapping[str, float]) -> float:
    """The largest weight of a stem among these words."""
    return max((weight for stem, weight in weights.items() if has_word(words, stem)), default=0.0)


def _score(wanted: str, table: LabTable, name: str) -> float:
    """Score of a name and its unit: weights of words for it, 2 for a unit, minus words against it."""
    words, unit = _all_words(table, name), unit_in(name)
    known = [quantity for quantity in MeasuredQuantity if factor_of(unit, quantity) is not None]
    foreign = bool(known) and QUANTITIES[wanted] not in known
    base, tip = 2.0 * has_word(words, _BASE), 2.0 * has_word(words, _TIP)
    rate = has_word(words, _RATE) or MeasuredQuantity.ANGULAR_RATE in known
    angle = 2.0 * has_word(words, _ANGLE)
    torque, depth = weight_of(words, _TORQUE), weight_of(words, _DEPTH)
    still = 3.0 * (_span(table.columns[name]) == 0)
    # A linear rig has lengths for angles and forces for torques: asked, but not ruled out.
    linear = wanted in ("base_angle_deg", "base_torque_n_mm")
    fits, weight = {
        "base_angle_deg": (
            angle + base > 0 and not (tip or rate or torque or depth),
            angle + base - still,
        ),
        "tip_angle_deg": (tip > 0 and not (rate or torque), angle + tip),
        "base_torque_n_mm": (torque > 0 and not tip, torque + base / 2 + ("z" in words)),
        "tip_torque_n_mm": (torque > 0 and tip > 0, torque + tip),
        "inserted_mm": (depth > 0 and not (rate or torque or tip or has_word(words, "free")), depth),
        "free_mm": (has_word(words, "free") and not rate, 3.0),
        "speed_mm_s": (rate and not (tip or base), weight_of(words, _SPEED)),
    }[wanted]
    if not fits or (foreign and not linear):
        return _NONE
    unit_weight = 2.0 if known and not foreign else 0.0
    against = 2.0 * has_word(words, _COMMANDED) + 5.0 * has_word(words, _OTHER)
    return weight + unit_weight - against


def _all_words(table: LabTable, name: str) -> list[str]:
    return [*words_of(without_unit(name)), *words_of(table.words.get(name, ""))]


def _matches(word: str, stem: str) -> bool:
    return word.startswith(stem[:-1]) if stem.endswith("*") else word.rstrip("0123456789") == stem


def _span(values: Array) -> float:
    finite = values[np.isfinite(values)]
    return float(np.ptp(finite)) if finite.size else 0.0
