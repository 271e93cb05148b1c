"""MCAP: every number of every topic as a column `topic.field[index]`, one table for each topic.

ROS 2 messages have their definition in the file, so any type can be read; so can channels of JSON.
A topic has two times: that of the header (of the measurement), if its type has one, and `log_time`
(of the recording).
"""

import json
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from mcap.reader import make_reader
from mcap.records import Channel, Schema
from mcap_ros2.decoder import DecoderFactory

from diagnosis.lab_files.readers.lab_table import Array, LabFile, LabTable
from models.errors import InvalidValue

_MOST_ITEMS = 64
# What readers and decoders raise on bytes that they were not made for.
_PARTS_OF_A_STAMP = ({"sec", "nanosec"}, {"sec", "nsec"}, {"secs", "nsecs"})
Decode = Callable[[bytes], Any]


@dataclass(frozen=True, kw_only=True)
class _Topic:
    """A topic as far as it has been read: rows of numbers, and texts."""

    ros: bool
    rows: list[dict[str, float]] = field(default_factory=list)
    texts: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))


def read_mcap_file(path: Path) -> LabFile:
    """Read all topics that can be decoded; the others are named in the notes.

    Raises:
      InvalidValue: the file is not MCAP, is cut off, or has no numbers; names it.
    """
    try:
        topics, unknown = _topics(path)
    except Exception as error:  # decoders raise all kinds on broken bytes, some of their own
        reason = f"{type(error).__name__}: {str(error)[:200]}"
        raise InvalidValue(
            str(path), reason, "a complete MCAP file", "try `mcap recover` if it was cut off"
        ) from error
    notes = [
        f"{path.name}: {topic} is encoded as {how} and is left out" for topic, how in unknown.items()
    ]
    tables = []
    for name, topic in topics.items():
        if any(len(seen) > 1 for text, seen in topic.texts.items() if ".name[" in text):
            notes.append(f"{path.name}: {name} lists its joints in changing order and is left out")
        else:
            tables.append(_table(path, name, topic))
    if not tables:
        raise InvalidValue(
            str(path), "; ".join(notes) or "no message", "ROS 2 or JSON topics with numbers"
        )
    return LabFile(path=path, tables=tuple(tables), notes=tuple(notes))


def _topics(path: Path) -> tuple[dict[str, _Topic], dict[str, str]]:
    factory, decoders = DecoderFactory(), dict[int, Decode | None]()
    topics: dict[str, _Topic] = {}
    unknown: dict[str, str] = {}
    with path.open("rb") as file:
        for schema, channel, message in make_reader(file).iter_messages():
            if channel.id not in decoders:
                decoders[channel.id] = _decoder(factory, schema, channel)
            decode = decoders[channel.id]
            if decode is None:
                unknown[channel.topic] = channel.message_encoding
                continue
            topic = topics.setdefault(channel.topic, _Topic(ros=channel.message_encoding == "cdr"))
            row = {f"{channel.topic}.log_time": message.log_time / 1e9}
            for name, value in _leaves(decode(message.data), channel.topic):
                if isinstance(value, str):
                    topic.texts[name].add(value)
                else:
                    row[name] = value
            topic.rows.append(row)
    return topics, unknown


def _decoder(factory: DecoderFactory, schema: Schema | None, channel: Channel) -> Decode | None:
    if channel.message_encoding == "json":
        return json.loads
    return factory.decoder_for(channel.message_encoding, schema)


def _leaves(value: Any, name: str) -> Iterator[tuple[str, float | str]]:
    """Numbers and texts of a message by their path; a time stamp is one number, in seconds."""
    fields = _fields(value)
    if fields is not None and set(fields) in _PARTS_OF_A_STAMP:
        seconds, rest = fields.values()
        yield name, float(seconds) + 1e-9 * float(rest)
    elif fields is not None:
        for key, inner in fields.items():
            yield from _leaves(inner, f"{name}.{key}")
    elif isinstance(value, str):
        yield name, value
    elif isinstance(value, int | float):
        yield name, float(value)
    elif hasattr(value, "__len__") and not isinstance(value, bytes) and len(value) <= _MOST_ITEMS:
        for i, inner in enumerate(value):
            yield from _leaves(inner, f"{name}[{i}]")


def _fields(value: Any) -> dict[str, Any] | None:
    if isinstance(value, dict):
        return value
    slots = getattr(value, "__slots__", None)
    return None if slots is None else {slot: getattr(value, slot) for slot in slots}


def _table(path: Path, name: str, topic: _Topic) -> LabTable:
    names = list(dict.fromkeys(key for row in topic.rows for key in row))
    columns: dict[str, Array] = {
        key: np.array([row.get(key, np.nan) for row in topic.rows]) for key in names
    }
    return LabTable(
        title=f"{path.name}, {name}", columns=columns, words=_words(names, topic), ros_units=topic.ros
    )


def _words(names: list[str], topic: _Topic) -> dict[str, str]:
    """Joint names by column: `position[0]` belongs to the joint `name[0]`."""
    found = {}
    for text, seen in topic.texts.items():
        stem, mark, index = text.rpartition(".name[")
        if mark:
            for name in names:
                if name.startswith(stem) and name.endswith(f"[{index}"):
                    found[name] = next(iter(seen))
    return found
