"""Protocols: an experiment on a needle in tissue, as validated records.

A protocol is a sequence of segments. Over `duration_s` of each the base turns by
`turn_deg` at a constant rate (or holds `torque_n_mm`), while the needle advances by
`advance_mm` (negative: retracts). A needle that passes `through` a slab keeps its
inserted length; else the inserted length grows by what the free length loses.
"""

from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, field_validator, model_validator

from models.drive import Drive, DriveKind
from models.errors import InvalidValue
from models.materials import tissue_named
from models.names import refuse_no_file_name
from models.needle import DENSEST_G_CM3, NITINOL, Needle, NonNegative, Positive, needle_named
from models.plain_yaml import read_record, read_yaml
from models.record import Record
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.law_table import law_table
from sim.needles.setup import Setup
from sim.protocol_cost import refuse_costly, samples_of
from sim.schedule import LENGTH_TOLERANCE_MM, Schedule

_STIFFEST_GPA = 1000.0  # twice as stiff as diamond: most likely another unit
_LARGEST, _SMALLEST = 1e9, 1e-18  # of any number in a file, in its own unit: no rig has more, or less


class Segment(Record):
    """An interval in which all inputs are linear in time, apart from dither."""

    duration_s: Positive
    turn_deg: float = 0.0
    torque_n_mm: float | None = None
    """Base torque during the segment, for a torque-driven needle."""
    advance_mm: float = 0.0
    tip_torque_n_mm: float = 0.0
    dither_deg: NonNegative = 0.0
    """Amplitude of a sine on the base angle."""
    dither_hz: NonNegative = 0.0

    @model_validator(mode="after")
    def _dither_is_whole(self) -> "Segment":
        if (self.dither_deg > 0) != (self.dither_hz > 0):
            raise InvalidValue("dither_hz", self.dither_hz, "both dither_deg and dither_hz, or neither")
        return self


class Protocol(Record):
    """An experiment: rig, start and segments."""

    name: str
    description: str = ""
    needle: Needle = NITINOL
    tissue: Tissue
    drive: Drive = Drive()
    discretisation: Discretisation = Discretisation()
    free_mm: NonNegative
    inserted_mm: NonNegative
    through: bool = False
    """The needle passes through the tissue: its inserted length stays."""
    segments: Annotated[tuple[Segment, ...], Field(min_length=1)]
    accuracy_deg: Positive | None = None
    """If given, the error of the tip that the step may cause; a larger one is an error."""

    @field_validator("name")
    @classmethod
    def _name_is_of_a_file(cls, value: str) -> str:
        refuse_no_file_name("name", value)
        return value

    @field_validator("needle", mode="before")
    @classmethod
    def _needle_by_name(cls, value: Any) -> Any:
        return needle_named(value) if isinstance(value, str) else value

    @field_validator("tissue", mode="before")
    @classmethod
    def _tissue_by_name(cls, value: Any) -> Any:
        return tissue_named(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _is_possible(self) -> "Protocol":
        if self.needle.density_g_cm3 > DENSEST_G_CM3:
            raise InvalidValue(
                "needle.density_g_cm3",
                self.needle.density_g_cm3,
                f"at most {DENSEST_G_CM3:g} g/cm3",
                "check that the value is in g/cm3",
            )
        shaft = self.free_mm + self.inserted_mm
        if shaft > self.needle.length_mm + LENGTH_TOLERANCE_MM:
            raise InvalidValue(
                "needle.length_mm",
                self.needle.length_mm,
                f"at least the {shaft:g} mm of free_mm + inserted_mm",
                "take a longer needle",
            )
        if self.through and self.inserted_mm == 0:
            raise InvalidValue("inserted_mm", 0.0, "a depth above 0 for a needle that passes through")
        free, inserted = self.free_mm, self.inserted_mm
        for i, segment in enumerate(self.segments):
            free -= segment.advance_mm
            inserted += 0.0 if self.through else segment.advance_mm
            if free < -LENGTH_TOLERANCE_MM or inserted < -LENGTH_TOLERANCE_MM:
                raise InvalidValue(
                    f"segments.{i}.advance_mm",
                    segment.advance_mm,
                    "a motion that leaves free and inserted length at 0 mm or more, "
                    f"not {free:g} mm free and {inserted:g} mm inserted",
                )
            self._check_drive(i, segment)
        rows = len(law_table(self.needle, self.drive, self.tissue))
        refuse_costly(self.segments, self.discretisation, layers=len(self.tissue.layers), rows=rows)
        return self

    def _check_drive(self, i: int, segment: Segment) -> None:
        torque_driven = self.drive.kind is DriveKind.TORQUE
        if torque_driven and segment.torque_n_mm is None:
            raise InvalidValue(f"segments.{i}.torque_n_mm", None, "a torque, as drive.kind is torque")
        if torque_driven and (segment.turn_deg or segment.dither_deg):
            raise InvalidValue(f"segments.{i}.turn_deg", segment.turn_deg, "0, as drive.kind is torque")
        if not torque_driven and segment.torque_n_mm is not None:
            raise InvalidValue(
                f"segments.{i}.torque_n_mm", segment.torque_n_mm, "nothing, as drive.kind is angle"
            )

    def schedule(self) -> Schedule:
        """The inputs of the run over time."""
        columns: dict[str, list[float]] = {
            "time_s": [],
            "drive": [],
            "free_mm": [],
            "inserted_mm": [],
            "speed_mm_s": [],
            "tip_torque_n_mm": [],
        }
        time, angle, free = 0.0, 0.0, self.free_mm
        ends = pairwise(self._inserted_mm())
        for segment, (inserted, then) in zip(self.segments, ends, strict=True):
            share = np.linspace(0.0, 1.0, int(np.ceil(samples_of(segment))))
            at = time + segment.duration_s * share
            # A jump at the border of two segments takes one part in 10^6 of a segment.
            at[0] += 1e-6 * segment.duration_s if columns["time_s"] else 0.0
            wave = segment.dither_deg * np.sin(
                2 * np.pi * segment.dither_hz * segment.duration_s * share
            )
            turned = angle + segment.turn_deg * share + wave
            torque = segment.torque_n_mm
            columns["time_s"] += list(at)
            columns["drive"] += list(turned if torque is None else np.full(share.size, torque))
            columns["free_mm"] += list(np.maximum(free - segment.advance_mm * share, 0.0))
            columns["inserted_mm"] += list(inserted + (then - inserted) * share)
            speed = segment.advance_mm / segment.duration_s
            columns["speed_mm_s"] += [speed] * share.size
            columns["tip_torque_n_mm"] += [segment.tip_torque_n_mm] * share.size
            time += segment.duration_s
            angle = float(turned[-1])
            free -= segment.advance_mm
        return Schedule(**{name: np.array(values) for name, values in columns.items()})

    def _inserted_mm(self) -> NDArray[np.float64]:
        """Inserted length at the start and at the ends of the segments, mm; linear between them."""
        gains = [0.0 if self.through else segment.advance_mm for segment in self.segments]
        ends: NDArray[np.float64] = np.cumsum([self.inserted_mm, *gains])
        return np.maximum(ends, 0.0)

    def setup(self) -> Setup:
        """The model that the run needs."""
        return Setup(
            needle=self.needle,
            tissue=self.tissue,
            drive=self.drive,
            discretisation=self.discretisation,
            mesh=self.schedule().mesh,
            free_mm=self.free_mm,
            inserted_mm=self.inserted_mm,
        )


def read_protocol(path: Path) -> Protocol:
    """Read and check a protocol from YAML.

    Raises:
      InvalidValue: the file is not YAML, not a protocol, or holds an implausible value; names
        the file and the field.
    """
    content = read_yaml(path, expected="a mapping of the fields of a protocol")
    protocol = read_record(path, Protocol, content)
    _refuse_out_of_scale(path, protocol.model_dump(exclude_unset=True), "")
    if protocol.needle.shear_modulus_gpa > _STIFFEST_GPA:
        raise InvalidValue(
            f"{path}: needle.shear_modulus_gpa",
            protocol.needle.shear_modulus_gpa,
            f"at most {_STIFFEST_GPA:g} GPa",
            "check that the value is in GPa",
        )
    return protocol


def _refuse_out_of_scale(path: Path, value: Any, field: str) -> None:
    """Refuse numbers far beyond any real rig: their simulation would fail or be meaningless."""
    inner: Iterable[tuple[Any, Any]] = value.items() if isinstance(value, dict) else ()
    inner = enumerate(value) if isinstance(value, list | tuple) else inner
    for name, part in inner:
        _refuse_out_of_scale(path, part, f"{field}.{name}" if field else str(name))
    if isinstance(value, float) and value != 0 and not _SMALLEST <= abs(value) <= _LARGEST:
        expected = f"a number of a size from {_SMALLEST:g} to {_LARGEST:g}, or 0"
        raise InvalidValue(f"{path}: {field}", value, expected, "check its unit")
