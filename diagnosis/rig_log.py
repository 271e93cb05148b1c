"""Reading `rig-log/1`: a folder with `rig.yaml` and one CSV a trial.

`rig.yaml` holds what the experimenter believes of the rig: the nominal model.
Nothing is guessed: a missing column or field is an error that names it.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
import pandas as pd
import yaml
from numpy.typing import NDArray
from pydantic import Field

from models.errors import InvalidValue, NeedleError
from models.needle import NonNegative, Positive
from models.record import Record
from sim.schedule import Schedule

Array = NDArray[np.float64]

REQUIRED = ("time_s", "base_angle_deg", "inserted_mm", "free_mm", "speed_mm_s")
SENSORS = ("base_torque_n_mm", "tip_angle_deg")
OPTIONAL = (*SENSORS, "tip_torque_n_mm")
_LARGEST_YAML = 1_000_000  # bytes


class UnusableLog(NeedleError):
    """A log that cannot be used: file, line or column, what was expected, the mend."""


class NominalNeedle(Record):
    """The needle as the experimenter believes it to be."""

    diameter_mm: Positive
    shear_modulus_gpa: Positive
    density_g_cm3: Positive


class NominalTissue(Record):
    """The tissue as the experimenter believes it to be."""

    damping_n_mm_s_per_mm: Positive


class SensorNoise(Record):
    """One standard deviation of each sensor, as claimed."""

    tip_angle_noise_deg: NonNegative
    base_torque_noise_n_mm: NonNegative
    base_angle_noise_deg: NonNegative


class TrialEntry(Record):
    """Where a trial is."""

    file: str


class Rig(Record):
    """`rig.yaml`."""

    format: Literal["rig-log/1"]
    needle: NominalNeedle
    tissue: NominalTissue
    sensors: SensorNoise
    trials: tuple[TrialEntry, ...] = Field(min_length=1)


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One trial: a table with the columns of the format, one row a sample.

    Attributes:
      name: of the file.
      table: required columns, and the optional ones that the file has.
    """

    name: str
    table: pd.DataFrame

    def __getitem__(self, column: str) -> Array:
        return np.asarray(self.table[column], float)

    def has(self, sensor: str) -> bool:
        """Whether the trial measured this at all."""
        return sensor in self.table and bool(self.table[sensor].notna().any())

    def schedule(self) -> Schedule:
        """What was done to the needle, as the rig measured it."""
        tip = np.nan_to_num(self["tip_torque_n_mm"]) if self.has("tip_torque_n_mm") else np.zeros(0)
        return Schedule(
            time_s=self["time_s"],
            drive=self["base_angle_deg"],
            free_mm=self["free_mm"],
            inserted_mm=self["inserted_mm"],
            speed_mm_s=self["speed_mm_s"],
            tip_torque_n_mm=tip,
        )


@dataclass(frozen=True, kw_only=True)
class RigLog:
    """A rig's log: the nominal rig and its trials."""

    rig: Rig
    trials: tuple[Trial, ...]


def read_rig_log(folder: Path) -> RigLog:
    """Read and check a log.

    Raises:
      UnusableLog: names the file, the line or column, and the way out.
    """
    rig = _read_rig(folder / "rig.yaml")
    return RigLog(rig=rig, trials=tuple(_read_trial(folder / entry.file) for entry in rig.trials))


def _read_rig(path: Path) -> Rig:
    try:
        if path.stat().st_size > _LARGEST_YAML:
            raise UnusableLog(f"{path}: larger than {_LARGEST_YAML} bytes; is it a rig.yaml?")
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError, RecursionError) as error:
        raise UnusableLog(f"{path}: expected a readable YAML file; {error}") from error
    if not isinstance(content, dict):
        raise UnusableLog(f"{path}: expected a mapping that starts with 'format: rig-log/1'")
    try:
        return Rig(**content)
    except (InvalidValue, TypeError) as error:
        raise UnusableLog(f"{path}: {error}") from error


def _read_trial(path: Path) -> Trial:
    try:
        table = pd.read_csv(path)
    except (OSError, ValueError) as error:
        raise UnusableLog(f"{path}: expected a readable CSV file; {error}") from error
    missing = [name for name in REQUIRED if name not in table.columns]
    if missing:
        found = ", ".join(map(str, table.columns))
        raise UnusableLog(f"{path}: column {missing[0]!r} is missing; the file has {found}")
    for name in (*REQUIRED, *(c for c in OPTIONAL if c in table.columns)):
        table[name] = _numbers(path, table[name], empty_allowed=name in OPTIONAL)
    trial = Trial(name=path.name, table=table)
    try:
        trial.schedule()
    except InvalidValue as error:
        raise UnusableLog(f"{path}: {error}") from error
    return trial


def _numbers(path: Path, column: pd.Series, *, empty_allowed: bool) -> pd.Series:
    values = pd.to_numeric(column, errors="coerce")
    unreadable = values.isna() & (column.notna() if empty_allowed else True)
    if unreadable.any():
        row = int(np.flatnonzero(unreadable)[0])
        place = f"{path}, line {row + 2}, column {column.name!r}"
        raise UnusableLog(f"{place}: expected a number, got {column.iloc[row]!r}")
    return values.astype(float)
