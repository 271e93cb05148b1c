"""Reading `rig.yaml`.

YAML lets a small file stand for a huge one (aliases), and the last of two equal keys
win; neither is wanted here, and both are refused before anything is built from them.
"""

from itertools import pairwise
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

import yaml

from diagnosis.criteria import NOMINAL_RANGE, YAML_MOST_BYTES, YAML_MOST_LEVELS
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
from models.record import Record

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
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
    content = _plain_yaml(path)
    if not (isinstance(content, dict) and all(isinstance(name, str) for name in content)):
        raise UnusableLog(f"{path}: expected a mapping that starts with 'format: rig-log/1'")
    for section, record in _SECTIONS.items():
        if isinstance(content.get(section), dict):
            _refuse_other_names(f"{path}: {section}", content[section], record)
    try:
        rig = NominalRig(**content)
    except (InvalidValue, TypeError) as error:
        raise UnusableLog(f"{path}: {_short(error).removeprefix('NominalRig.')}") from error
    _refuse_implausible(path, rig)
    _refuse_odd_files(path, [entry.file for entry in rig.trials])
    return rig


def _plain_yaml(path: Path) -> Any:
    if not path.is_file():
        raise UnusableLog(f"{path}: expected a rig-log/1 folder with a file 'rig.yaml'; there is none")
    try:
        if path.stat().st_size > YAML_MOST_BYTES:
            raise UnusableLog(f"{path}: expected at most {YAML_MOST_BYTES} bytes; is it a rig.yaml?")
        text = path.read_text(encoding="utf-8-sig")
        _refuse_bomb(path, text)
        _refuse_double(path, yaml.compose(text, Loader=_LOADER))
        return yaml.load(text, Loader=_LOADER)
    except (OSError, ValueError, yaml.YAMLError) as error:
        raise UnusableLog(f"{path}: expected a readable YAML file; {_short(error)}") from error


def _refuse_bomb(path: Path, text: str) -> None:
    """Looks at the events alone: nothing is built yet."""
    depth = 0
    for event in yaml.parse(text, Loader=_LOADER):
        place = f"{path}, {_line(event)}"
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(
            event, yaml.CollectionEndEvent
        )
        if depth > YAML_MOST_LEVELS:
            raise UnusableLog(f"{place}: expected at most {YAML_MOST_LEVELS} levels; is it a rig.yaml?")
        anchor = getattr(event, "anchor", None)
        if anchor is not None:
            raise UnusableLog(
                f"{place}: expected plain values, found the anchor or alias {anchor[:40]!r}; "
                "write the value out in each place"
            )


def _refuse_double(path: Path, node: yaml.Node | None) -> None:
    if isinstance(node, yaml.MappingNode):
        keys = sorted((key for key, _ in node.value), key=lambda key: str(key.value))
        for one, other in pairwise(keys):
            if one.value == other.value:
                raise UnusableLog(f"{path}, {_line(other)}: {one.value!r} is there twice; remove one")
        for _, value in node.value:
            _refuse_double(path, value)


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
    """A log is read inside its folder alone, and each trial gives one file of predictions."""
    names = [PurePosixPath(file.replace("\\", "/")).name for file in files]
    for i, file in enumerate(files):
        place = f"{path}: trials.{i}.file"
        parts = PurePosixPath(file.replace("\\", "/"))
        if parts.is_absolute() or PureWindowsPath(file).drive or ".." in parts.parts or "\0" in file:
            raise UnusableLog(f"{place}: expected a file in the folder of the log, found {file[:80]!r}")
        if names[i] in names[:i]:
            raise UnusableLog(f"{place}: {file!r} is named twice; remove or rename one of the two")


def _line(marked: yaml.Event | yaml.Node) -> str:
    return f"line {marked.start_mark.line + 1}" if marked.start_mark else "somewhere"


def _short(error: Exception) -> str:
    return " ".join(str(error).split())[:400]
