"""`mapping.yaml`: which column of a lab's files is which column of rig-log/1, and in what unit.

    rig-log value = sign * factor * (value in the file - zero)

with the factor from the unit, or stated. Fields that may be blank in these records may not be blank in a
mapping that is applied: `read_mapping.py` checks that.
"""

from typing import Annotated, Any, Literal

from pydantic import Field

from diagnosis.lab_files.units import QUANTITIES, RATES, MeasuredQuantity, factor_of
from diagnosis.log.nominal_rig import NominalInertia, NominalNeedle, NominalTissue, SensorNoise
from diagnosis.log.trial import COLUMNS
from models.record import Record

FIRST_REST = "first_rest"
MEASURED = tuple(name for name in COLUMNS if name != "time_s")
SECTIONS: dict[str, type[Record]] = {
    "needle": NominalNeedle,
    "tissue": NominalTissue,
    "inertia": NominalInertia,
    "sensors": SensorNoise,
}


class TimeSource(Record):
    """A column of times, and their unit."""

    column: str
    unit: str | None = None
    factor: Annotated[float, Field(gt=0)] | None = None
    """Seconds per unit of the file, for a unit that is not known."""
    guess: bool = False

    @property
    def seconds(self) -> float:
        """Seconds in one of its units."""
        return self.factor or factor_of(self.unit or "", MeasuredQuantity.TIME) or 1.0


class ColumnSource(Record):
    """The source of one column of rig-log/1."""

    column: str | None = None
    file: int | None = None
    """Which of the trial's lab files has it, from 1; needed if several have a column of that name."""
    unit: str | None = None
    factor: float | None = None
    """Units of rig-log/1 per unit of the file, for a unit that is not known."""
    sign: Literal[1, -1] = 1
    zero: float | Literal["first_rest"] = 0.0
    """Subtracted first, in the file's unit; `first_rest`: the mean of each trial's first rest."""
    time_offset_s: float = 0.0
    """Added to the times of this column: a clock that is behind has a positive one."""
    unwrap: bool = False
    """Whether its readings jump by a turn at the end of their range, and turns are to be counted."""
    derive: Literal["integrate", "differentiate"] | None = None
    """Of the file's values over time: an angle from a rate, a speed from a position."""
    start: float = 0.0
    """Value of an integral at the first sample, in the unit of rig-log/1."""
    guess: bool = False
    """Guessed by a draft and confirmed by nobody: refused."""

    def quantity(self, wanted: str) -> MeasuredQuantity | None:
        """The quantity of the file's column, if the wanted one can follow from it; else None."""
        own = QUANTITIES[wanted]
        if self.derive == "integrate":
            return RATES.get(own)
        if self.derive == "differentiate":
            return {rate: of for of, rate in RATES.items()}.get(own)
        return own

    def scale(self, wanted: str) -> float:
        """Units of rig-log/1 per unit of the file, with the sign."""
        quantity = self.quantity(wanted)
        known = factor_of(self.unit or "", quantity) if quantity else None
        return self.sign * (self.factor or known or 1.0)


class TrialSource(Record):
    """The lab files of one trial."""

    file: str
    """Name of the trial in the log that is written."""
    lab_files: Annotated[tuple[str, ...], Field(min_length=1)]
    constants: dict[str, float | None] = Field(default_factory=dict)
    """Columns that the rig does not measure; these come before those of the whole mapping."""
    guess: bool = False


class ImportMapping(Record):
    """All of `mapping.yaml`."""

    format: Literal["rig-import/1"]
    trials: Annotated[tuple[TrialSource, ...], Field(min_length=1)]
    times: tuple[TimeSource, ...] = ()
    """Each table takes its times from the first of these columns that it has."""
    sample_hz: Annotated[float, Field(gt=0)] | None = None
    """Samples per second of files without times."""
    resample_hz: Annotated[float, Field(gt=0)] | None = None
    """Rows per second of the log, if it is to be resampled."""
    columns: dict[str, ColumnSource]
    constants: dict[str, float | None] = Field(default_factory=dict)
    """Columns that the rig does not measure: one number for all rows of all trials."""
    needle: dict[str, float | None]
    tissue: dict[str, float | None]
    inertia: dict[str, float | None] = Field(default_factory=dict)
    """What turns with the needle; may be left out, as in `rig.yaml`."""
    sensors: dict[str, float | None]

    def constant(self, trial: TrialSource, column: str) -> float | None:
        """The constant value of a column in a trial, if one is stated."""
        return trial.constants.get(column, self.constants.get(column))


def guesses(mapping: ImportMapping) -> list[str]:
    """Entries that a draft guessed and the user has not confirmed."""
    found = [f"trials.{t.file}" for t in mapping.trials if t.guess]
    found += [f"times.{t.column}" for t in mapping.times if t.guess]
    return found + [f"columns.{name}" for name, source in mapping.columns.items() if source.guess]


def as_rig(mapping: ImportMapping) -> dict[str, Any]:
    """The content of `rig.yaml`."""
    sections = {name: stated for name in SECTIONS if (stated := getattr(mapping, name))}
    return {"format": "rig-log/1", **sections, "trials": [{"file": t.file} for t in mapping.trials]}
