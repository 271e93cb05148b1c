"""A draft of a mapping: guesses with their reasons, and open questions. Nothing is refused."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.lab_files.guesses.columns import (
    Open,
    guessed_sources,
    guessed_trials,
)
from diagnosis.lab_files.guesses.from_motion import (
    loops_of,
    needed_rate_hz,
    noise_of,
    with_offset,
    with_sign,
    with_zero,
)
from diagnosis.lab_files.guesses.guessed import GuessedColumn, GuessedTimes
from diagnosis.lab_files.guesses.hysteresis import LoopShape
from diagnosis.lab_files.guesses.times import guessed_time_columns
from diagnosis.lab_files.guesses.tip_candidates import TipCandidate, tip_candidates
from diagnosis.lab_files.mapping import ImportMapping, TrialSource
from diagnosis.lab_files.motion import Motion, motion_of
from diagnosis.lab_files.readers.lab_table import LabFile, LabTable
from diagnosis.lab_files.runs import each_run
from diagnosis.lab_files.series import NoTimes, Series, raw_series
from models.errors import InvalidValue

NOISES = {
    "tip_angle_noise_deg": "tip_angle_deg",
    "base_torque_noise_n_mm": "base_torque_n_mm",
    "base_angle_noise_deg": "base_angle_deg",
}
"""Fields of `sensors` and the columns that they are the noise of."""


@dataclass(frozen=True, kw_only=True)
class Draft:
    """All guesses, and all open questions.

    Attributes:
      resample_hz: rows per second, if columns have separate clocks.
      noise: by field of `sensors`, in its unit; None: unknown scale, or no such sensor.
      noise_in_files: if the scale is unknown: in the unit of the file, in words.
      loops: loops of torque over base angle, in `loop_units`; None: no torque or no reversals.
      open: what the user has to decide or add.
      unused: columns for which no use was found.
      tip_candidates: those of them that may be the angle of the tip.
      motions: motions of the base, by trial.
      series: guessed columns as they are in the files, by trial.
      tables: all columns of the first trial.
    """

    trials: tuple[TrialSource, ...]
    times: tuple[GuessedTimes, ...]
    columns: tuple[GuessedColumn, ...]
    resample_hz: float | None
    noise: Mapping[str, float | None]
    noise_in_files: Mapping[str, str]
    loops: LoopShape | None
    loop_units: tuple[str, str]
    open: tuple[str, ...]
    unused: tuple[str, ...]
    tip_candidates: tuple[TipCandidate, ...]
    motions: Mapping[str, Motion]
    series: Mapping[str, Mapping[str, Series]]
    tables: tuple[LabTable, ...]


def drafted(files: Sequence[LabFile]) -> Draft:
    """Guess a mapping for lab files; everything that cannot be guessed is listed in `open`."""
    open_: Open = []
    files = each_run(files)
    trials = guessed_trials(files, open_)
    tables = [table for file in files if file.path.name in trials[0].lab_files for table in file.tables]
    times = guessed_time_columns(files, open_)
    columns = guessed_sources(tables, times, open_)
    series = _series(trials, files, times, columns, open_)
    motions = _motions(series)
    open_.append("needle, tissue: the files do not state the constants of the rig; fill the blanks")
    columns = [with_offset(column, series) for column in columns]
    columns = [with_zero(column, series, motions) for column in columns]
    columns = [with_sign(column, series) for column in columns]
    by_name = {column.wanted: column for column in columns}
    base, torque = by_name.get("base_angle_deg"), by_name.get("base_torque_n_mm")
    noise = {field: noise_of(by_name.get(of), series, motions) for field, of in NOISES.items()}
    open_noise = {
        field: f"{noise[field]:.3g} {_unit(by_name[of], '')}"
        for field, of in NOISES.items()
        if noise[field] is not None and not by_name[of].known
    }
    used = {c.source.column for c in columns} | {time.source.column for time in times}
    unused = [n for t in tables for n in t.columns if n not in used and not n.endswith(".log_time")]
    candidates = tip_candidates(columns, tables, unused)
    open_ += [f"tip_angle_deg: {one.column!r}: {one.reason}" for one in candidates]
    return Draft(
        trials=tuple(trials),
        times=tuple(times),
        columns=tuple(columns),
        resample_hz=needed_rate_hz(columns, series),
        noise={field: None if field in open_noise else noise[field] for field in NOISES},
        noise_in_files=open_noise,
        loops=loops_of(base, torque, series, motions) if base and torque else None,
        loop_units=(_unit(base, "deg"), _unit(torque, "N mm")),
        open=tuple(open_),
        unused=tuple(unused),
        tip_candidates=candidates,
        motions=motions,
        series=series,
        tables=tuple(tables),
    )


def _series(
    trials: Sequence[TrialSource],
    files: Sequence[LabFile],
    times: Sequence[GuessedTimes],
    columns: Sequence[GuessedColumn],
    open_: Open,
) -> dict[str, dict[str, Series]]:
    """The guessed columns as they are in the files; unreadable ones are added to `open_`."""
    mapping = ImportMapping(
        format="rig-import/1",
        trials=tuple(trials),
        times=tuple(time.source for time in times),
        columns={column.wanted: column.source for column in columns},
        needle={},
        tissue={},
        sensors={},
    )
    found: dict[str, dict[str, Series]] = {trial.file: {} for trial in trials}
    for trial in trials:
        for column in columns:
            try:
                one = raw_series(mapping, trial, files, column.wanted)
            except NoTimes:
                continue  # asked for already, once for each table
            except InvalidValue as error:
                open_.append(str(error))
            else:
                if np.isfinite(one.values).sum() > 2:
                    found[trial.file][column.wanted] = one
    open_[:] = dict.fromkeys(open_)
    return found


def _motions(series: Mapping[str, Mapping[str, Series]]) -> dict[str, Motion]:
    bases = {name: own["base_angle_deg"] for name, own in series.items() if "base_angle_deg" in own}
    return {name: motion_of(base.time_s, base.values) for name, base in bases.items()}


def _unit(column: GuessedColumn | None, known: str) -> str:
    if column is None or column.known:
        return known
    return column.source.unit or "(unit of the file)"
