"""The content of a rerun file as a table, for machines without a screen."""

from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path

import pyarrow as pa
from rerun.chunk import RrdReader

from models.errors import InvalidValue, NeedleError
from models.names import is_file
from sim.recording.recording import unit_of
from sim.recording.rerun_series import TIMELINE

_SIGNAL = "Scalars:scalars"
_STYLES = ("SeriesLines:", "SeriesPoints:")
_NOTES = "/__"
_UNITS_OF = {"modes": "deg", "estimate": "deg"}


class NotARecording(NeedleError):
    """A file is not a readable rerun recording."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One component of one entity.

    Attributes:
      rows: values over time, or 1 for a static one.
      start_s, end_s: first and last time on the recording's timeline; None for a static component.
      last: last value of a signal.
      unit: unit of a signal, from its name; empty if the name has none.
    """

    entity: str
    component: str
    rows: int
    start_s: float | None
    end_s: float | None
    last: float | None
    unit: str = ""


def entries(path: Path) -> list[Entry]:
    """Every component in the file that holds data, in the order of entities.

    Colours and names of lines, and rerun's own properties of the file, are left out.

    Raises:
      NotARecording: the file is missing or not a rerun recording.
    """
    if not is_file(path):
        raise NotARecording(f"{path}: expected a rerun recording, found no such file")
    try:
        batches = [(str(c.entity_path), c.to_record_batch()) for c in RrdReader(str(path)).stream()]
    except Exception as error:  # rerun documents no type
        raise NotARecording(
            f"{path}: expected a rerun recording, found another format ({error})"
        ) from error
    found = [
        entry
        for entity, batch in batches
        if not entity.startswith(_NOTES)
        for entry in _entries(entity, batch)
    ]
    if not found:
        raise NotARecording(f"{path}: expected a rerun recording with data, found an empty one")
    ordered = sorted(found, key=lambda e: (e.entity, e.component, e.start_s or 0.0))
    return [_joined(list(g)) for _, g in groupby(ordered, key=lambda e: (e.entity, e.component))]


def _joined(chunks: list[Entry]) -> Entry:
    """One entry for a component that the file holds in several chunks."""
    rows = sum(chunk.rows for chunk in chunks)
    return replace(chunks[-1], rows=rows, start_s=chunks[0].start_s)


def _entries(entity: str, batch: pa.RecordBatch) -> list[Entry]:
    times = _times_s(batch)
    names = [n for n in batch.schema.names if ":" in n and not n.startswith(_STYLES)]
    return [
        Entry(
            entity=entity,
            component=name,
            rows=batch.num_rows,
            start_s=times[0] if times else None,
            end_s=times[-1] if times else None,
            last=_last_number(batch.column(name)) if name == _SIGNAL else None,
            unit=_unit(entity) if name == _SIGNAL else "",
        )
        for name in names
    ]


def _times_s(batch: pa.RecordBatch) -> list[float]:
    clock = _clock(batch.schema)
    if clock is None:
        return []
    nanoseconds = batch.column(clock).cast(pa.int64()).to_pylist()
    return [t * 1e-9 for t in nanoseconds if t is not None]


def _clock(schema: pa.Schema) -> str | None:
    """The timeline of a recording: this project's, or another one of durations."""
    durations = [f.name for f in schema if pa.types.is_duration(f.type)]
    return TIMELINE if TIMELINE in schema.names else next(iter(durations), None)


def _unit(entity: str) -> str:
    """The unit of a signal, from the nearest name that ends in one."""
    parts = entity.strip("/").split("/")
    if "residual" in parts:
        return "σ"
    for name in reversed(parts):
        if name in _UNITS_OF:
            return _UNITS_OF[name]
        with suppress(InvalidValue):
            return unit_of(name)
    return ""


def _last_number(column: pa.Array) -> float | None:
    value = column[-1].as_py() if len(column) else None
    if isinstance(value, list) and len(value) == 1:
        value = value[0]
    return float(value) if isinstance(value, int | float) else None
