"""Zeros, signs, clock offsets, noise and loops of the columns, from the motion of the base."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from diagnosis.criteria.lab_files import CLOCK_LEAST_S, CLOCK_SIGMA, TIP_LAG_AT_MOST_S
from diagnosis.lab_files.guesses.clock_offset import clock_offset
from diagnosis.lab_files.guesses.guessed import GuessedColumn
from diagnosis.lab_files.guesses.hysteresis import LoopShape, branches_of, kept_torques, loop_shape
from diagnosis.lab_files.guesses.signs import (
    SignGuess,
    speed_sign,
    tip_sign,
    torque_sign,
    zero_at_rest,
)
from diagnosis.lab_files.mapping import FIRST_REST
from diagnosis.lab_files.motion import Motion
from diagnosis.lab_files.readers.lab_table import Array
from diagnosis.lab_files.resampling import rate_hz
from diagnosis.lab_files.series import Series
from diagnosis.log.faults.scatter import quantum
from diagnosis.log.trial import SENSORS
from diagnosis.log.white_noise import white_noise

Trials = Mapping[str, Mapping[str, Series]]
Motions = Mapping[str, Motion]


def with_zero(column: GuessedColumn, trials: Trials, motions: Motions) -> GuessedColumn:
    """The column with a zero of angle or torque, from the rests at the start of trials."""
    if column.wanted not in (*SENSORS, "base_angle_deg") or column.source.derive:
        return column
    found = []
    for name, motion in motions.items():
        if column.wanted in trials[name]:
            one = _on_time(column, trials[name][column.wanted])
            found.append(zero_at_rest(one.values, one.time_s, motion, scatter([one.values])))
    values = [guess.value for guess in found if guess.value is not None]
    if not values:
        return column.with_guess("zero", found[0].reason if found else "the base's angle is not known")
    reason = next(guess.reason for guess in found if guess.value is not None)
    if len(values) > 1:
        reason = (
            f"median of {len(values)} trials that start at rest, {min(values):.4g} to "
            f"{max(values):.4g}; {FIRST_REST!r} takes each trial's own"
        )
    return column.with_guess("zero", reason, zero=float(f"{np.median(values):.6g}"))


def with_sign(column: GuessedColumn, trials: Trials) -> GuessedColumn:
    """The column with the sign that most trials suggest."""
    guesses = [guess for own in trials.values() if (guess := _sign_in(column, own))]
    told = [guess for guess in guesses if guess.sign is not None]
    if not told:
        reason = f"unchanged: {guesses[0].reason}" if guesses else "unchanged: nothing to compare with"
        return column.with_guess("sign", reason)
    sign = 1 if sum(int(guess.sign or 0) for guess in told) >= 0 else -1
    agree = [guess for guess in told if guess.sign == sign]
    counted = f"; {len(agree)} of {len(told)} trials agree" if len(told) > 1 else ""
    return column.with_guess("sign", agree[0].reason + counted, sign=sign)


def with_offset(column: GuessedColumn, trials: Trials) -> GuessedColumn:
    """The column with a clock offset, if its clock is another one; the tip's own lag is no offset."""
    if column.wanted not in SENSORS:
        return column
    found = []
    for own in trials.values():
        base, one = own.get("base_angle_deg"), own.get(column.wanted)
        if base is not None and one is not None:
            torque = column.wanted == "base_torque_n_mm"
            offset = clock_offset(one.time_s, one.values, base.time_s, base.values, torque=torque)
            found.append((offset, one.clock[0] != base.clock[0]))
    known = [pair for pair in found if pair[0].late_s is not None]
    if not known:
        return column.with_guess("time_offset_s", found[0][0].reason if found else "not estimated")
    offset, other_clock = min(known, key=lambda pair: pair[0].uncertainty_s or 0.0)
    late, uncertain = offset.late_s or 0.0, offset.uncertainty_s or 0.0
    reason = f"against the base: {offset.reason}"
    if column.wanted == "tip_angle_deg" and 0 <= late <= TIP_LAG_AT_MOST_S:
        return column.with_guess(
            "time_offset_s", f"{reason}; the needle itself makes the tip lag: 0 is used"
        )
    if not other_clock:
        return column.with_guess("time_offset_s", f"{reason}; same clock: 0 is used")
    if abs(late) <= max(CLOCK_SIGMA * uncertain, CLOCK_LEAST_S):
        return column.with_guess(
            "time_offset_s", f"{reason}; not significantly different from 0, which is used"
        )
    return column.with_guess(
        "time_offset_s", f"{reason}; the clocks differ", time_offset_s=float(f"{-late:.6g}")
    )


def needed_rate_hz(columns: Sequence[GuessedColumn], trials: Trials) -> float | None:
    """The sampling rate of the base, if columns have separate clocks; else None."""
    offsets = {column.wanted: column.source.time_offset_s for column in columns}
    for own in trials.values():
        if len({(one.clock[0], offsets[name]) for name, one in own.items()}) > 1:
            lead = own.get("base_angle_deg") or next(iter(own.values()))
            return float(f"{rate_hz(lead.time_s):.3g}")
    return None


def noise_of(column: GuessedColumn | None, trials: Trials, motions: Motions) -> float | None:
    """Standard deviation of white noise: at rest, or in whole trials if there is no rest.

    Returns:
      In units of rig-log/1, or of the file if its scale is unknown; None without such a column, or if
      none can be read.
    """
    if column is None or column.source.derive:
        return None
    parts = [own[column.wanted] for own in trials.values() if column.wanted in own]
    if not parts:
        return None
    rests = [
        own[column.wanted].values[motions[name].at_rest(_on_time(column, own[column.wanted]).time_s)]
        for name, own in trials.items()
        if column.wanted in own and name in motions
    ]
    found = scatter(rests) or scatter([one.values for one in parts])
    rounded = min((quantum(one.values) for one in parts), default=0.0) / float(np.sqrt(12))
    return float(f"{abs(column.scale) * max(found, rounded):.3g}")


def loops_of(
    base: GuessedColumn, torque: GuessedColumn, trials: Trials, motions: Motions
) -> LoopShape | None:
    """Common shape of all loops of torque over angle; None without torque or reversals."""
    branches, kept, noise = [], list[float](), 0.0
    for name, motion in motions.items():
        own, angle = trials[name].get(torque.wanted), trials[name][base.wanted]
        if own is not None:
            moved = base.scale * angle.values[np.isfinite(angle.values)]
            read = at_times(_on_time(torque, own), motion.time_s) - _zero(torque, own)
            branches += branches_of(motion, moved, torque.scale * read)
            kept += kept_torques(motion, moved, torque.scale * read)
            noise = max(noise, abs(torque.scale) * scatter([own.values]))
    return loop_shape(branches, kept, noise) if branches else None


def scatter(parts: Sequence[Array]) -> float:
    """Standard deviation of the white noise of readings; 0 if they are too few."""
    noise = white_noise(parts, order=2)
    return noise if np.isfinite(noise) else 0.0


def at_times(series: Series, time_s: Array) -> Array:
    """A column at other times, by linear interpolation."""
    good = np.isfinite(series.values)
    return np.interp(time_s, series.time_s[good], series.values[good])


def _on_time(column: GuessedColumn, series: Series) -> Series:
    """A column with its times on the clock of the base, to which all others are compared."""
    return replace(series, time_s=series.time_s + column.source.time_offset_s)


def _zero(torque: GuessedColumn, series: Series) -> float:
    """The guessed zero of the torque; without one, the middle between both directions."""
    return float(torque.source.zero) or float(np.nanquantile(series.values, (0.1, 0.9)).mean())


def _sign_in(column: GuessedColumn, own: Mapping[str, Series]) -> SignGuess | None:
    """The sign that one trial suggests; None: nothing to compare with."""
    base = own.get("base_angle_deg")
    if base is None or column.wanted not in own:
        return None
    one = _on_time(column, own[column.wanted])
    if column.wanted == "base_torque_n_mm":
        return torque_sign(at_times(one, base.time_s) - _zero(column, one), base.values)
    if column.wanted == "tip_angle_deg":
        return tip_sign(one.time_s, one.values, at_times(base, one.time_s))
    if column.wanted == "speed_mm_s" and not column.source.derive:
        for depth, grows in (("inserted_mm", True), ("free_mm", False)):
            if depth in own and np.ptp(own[depth].values) > 0:
                moved = at_times(own[depth], one.time_s)
                return speed_sign(one.time_s, one.values, moved, depth_grows=grows)
    return None
