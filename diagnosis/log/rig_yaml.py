"""Reads `rig.yaml`: its fields, and the names of its trials."""

from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from diagnosis.criteria.log import NOMINAL_RANGE
from diagnosis.log.nominal_rig import (
    NominalInertia,
    NominalNeedle,
    NominalRig,
    NominalTissue,
    SensorNoise,
)
from diagnosis.log.trial import UnusableLog
from diagnosis.log.unit_hints import look_alike
from models.errors import InvalidValue
from models.names import is_file, is_folder, refuse_no_file_name
from models.plain_yaml import read_record, read_yaml
from models.record import Record

_SECTIONS: dict[str, type[Record]] = {
    "needle": NominalNeedle,
    "tissue": NominalTissue,
    "inertia": NominalInertia,
    "sensors": SensorNoise,
}


def read_rig(path: Path) -> NominalRig:
    """Read and check a `rig.yaml`.

    Raises:
      UnusableLog: names the file, the field or line, and how to fix it.
    """
    if not is_file(path):
        raise UnusableLog(
            f"{path}: expected a rig-log/1 folder with a file 'rig.yaml'; {_instead_of(path)}"
        )
    try:
        content = read_yaml(path, expected="a mapping that starts with 'format: rig-log/1'")
        for section, record in _SECTIONS.items():
            if isinstance(content.get(section), dict):
                _refuse_other_names(f"{path}: {section}", content[section], record)
        rig = read_record(path, NominalRig, content)
    except InvalidValue as error:
        raise UnusableLog(str(error)) from error
    _refuse_implausible(path, rig)
    _refuse_odd_files(path, [entry.file for entry in rig.trials])
    return rig


def _instead_of(path: Path) -> str:
    """What is there in place of a rig.yaml, and what to do."""
    folder = path.parent
    if is_file(folder):
        return f"{folder} is a file: give its folder"
    if not is_folder(folder):
        return f"there is no folder {folder}"
    if is_file(folder / "rig.yml"):
        return "there is none; rename rig.yml"
    return "there is none; `needle import` makes a log of a lab's own files"


def _refuse_other_names(place: str, content: dict[Any, Any], record: type[Record]) -> None:
    known = list(record.model_fields)
    unknown = [str(name) for name in content if name not in known]
    for name in (name for name in known if name not in content):
        alike = look_alike(unknown, name, known)
        if alike:
            raise UnusableLog(
                f"{place}: field {name!r} is missing; {alike.found!r} looks like it: {alike.fix}"
            )


def _refuse_implausible(path: Path, rig: NominalRig) -> None:
    for (section, field), (low, high) in NOMINAL_RANGE.items():
        value = getattr(getattr(rig, section), field)
        if not low <= value <= high:
            raise UnusableLog(
                f"{path}: {section}.{field}: expected {low:g} to {high:g}, found {value:g}; "
                "is it in the unit of its name?"
            )


def _refuse_odd_files(path: Path, files: list[str]) -> None:
    """Refuse trials outside of the log's folder, and two trials of the same name."""
    names = [PurePosixPath(file.replace("\\", "/")).name for file in files]
    for i, file in enumerate(files):
        place = f"{path}: trials.{i}.file"
        parts = PurePosixPath(file.replace("\\", "/"))
        if parts.is_absolute() or PureWindowsPath(file).drive or ".." in parts.parts:
            raise UnusableLog(f"{place}: expected a file in the folder of the log, found {file[:80]!r}")
        try:
            refuse_no_file_name(place, names[i])
        except InvalidValue as error:
            raise UnusableLog(str(error)) from error
        if names[i] in names[:i]:
            again = f"expected each file once, found {file!r} again; remove or rename one of the two"
            raise UnusableLog(f"{place}: {again}")
