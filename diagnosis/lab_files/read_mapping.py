"""Reads a mapping; refuses everything that is blank, impossible or unconfirmed, in one error.

No value is filled in.
"""

from pathlib import Path

from diagnosis.lab_files.mapping import (
    MEASURED,
    SECTIONS,
    ColumnSource,
    ImportMapping,
    guesses,
)
from diagnosis.lab_files.units import QUANTITIES, UNITS, MeasuredQuantity, factor_of
from diagnosis.log.trial import REQUIRED, SENSORS
from models.errors import InvalidValue
from models.names import refuse_no_file_name
from models.plain_yaml import read_record, read_yaml

_EXPECTED = "a mapping that starts with 'format: rig-import/1' (`needle import` drafts one)"


def read_mapping(path: Path, *, accept_guesses: bool) -> ImportMapping:
    """Read and check a mapping.

    Args:
      accept_guesses: treat the guesses of a draft as confirmed.

    Raises:
      InvalidValue: it cannot be read; or lists all that is missing, impossible or unconfirmed.
    """
    content = read_yaml(path, expected=_EXPECTED)
    mapping = read_record(path, ImportMapping, content)
    wrong = [*_blanks(mapping), *_impossible(mapping)]
    if not accept_guesses:
        wrong += [
            f"{place}: delete 'guess: true' when you have checked it" for place in guesses(mapping)
        ]
    if wrong:
        some = "\n  ".join(wrong)
        raise InvalidValue(
            str(path), f"{len(wrong)} open", "a mapping without blanks or guesses", f"in it:\n  {some}"
        )
    return mapping


def _blanks(mapping: ImportMapping) -> list[str]:
    """Everything that is not stated yet."""
    found = []
    for time in mapping.times:
        if time.factor is None and time.unit is None:
            found.append(f"times.{time.column}: state 'unit', one of {_known(MeasuredQuantity.TIME)}")
    for name, source in mapping.columns.items():
        if source.column is None:
            found.append(
                f"columns.{name}.column: state the name of the column in the file, or remove the entry"
            )
        elif source.unit is None and source.factor is None:
            quantity = source.quantity(name) or QUANTITIES.get(name, MeasuredQuantity.ANGLE)
            found.append(
                f"columns.{name}: state 'unit' of {source.column!r}, one of {_known(quantity)}; or "
                f"'factor', {quantity} per unit of the file"
            )
    for trial in mapping.trials:
        for name in REQUIRED[1:]:
            if name not in mapping.columns and mapping.constant(trial, name) is None:
                found.append(
                    f"constants.{name} ({trial.file}): state a number, or a column under 'columns'"
                )
    for section, record in SECTIONS.items():
        values = getattr(mapping, section)
        fields = record.model_fields.items()
        needed = [n for n, field in fields if n in values or field.is_required()]
        found += [f"{section}.{n}: state a number" for n in needed if values.get(n) is None]
    return found


def _impossible(mapping: ImportMapping) -> list[str]:
    """Everything that is stated and impossible."""
    found = []
    for name, source in mapping.columns.items():
        if name not in MEASURED:
            found.append(
                f"columns.{name}: expected one of {', '.join(MEASURED)}; times belong in 'times'"
            )
            continue
        found += [f"columns.{name}{wrong}" for wrong in _wrong_unit(name, source)]
    for time in mapping.times:
        if (
            time.unit is not None
            and time.factor is None
            and not factor_of(time.unit, MeasuredQuantity.TIME)
        ):
            found.append(
                f"times.{time.column}.unit: {time.unit!r} is not known; state 'factor', seconds per unit"
            )
    stated = [("constants", mapping.constants)]
    stated += [(f"trials.{t.file}.constants", t.constants) for t in mapping.trials]
    for place, constants in stated:
        found += [
            f"{place}.{n}: expected one of {', '.join(MEASURED)}" for n in constants if n not in MEASURED
        ]
        found += [
            f"{place}.{n}: is under 'columns' too; remove one" for n in constants if n in mapping.columns
        ]
    files = [trial.file for trial in mapping.trials]
    found += [
        f"trials.{f}: appears twice; rename one" for f in dict.fromkeys(files) if files.count(f) > 1
    ]
    found += [f"trials.{f}: expected a name such as trial_01.csv" for f in files if not _plain_name(f)]
    if not any(name in mapping.columns for name in SENSORS):
        found.append(
            f"columns: expected {' or '.join(SENSORS)}; without readings there is nothing to compare"
        )
    if not mapping.times and mapping.sample_hz is None:
        found.append("times: state a column with times, or 'sample_hz', the samples per second")
    for section, record in SECTIONS.items():
        known = record.model_fields
        unknown = [n for n in getattr(mapping, section) if n not in known]
        found += [f"{section}.{n}: expected one of {', '.join(known)}" for n in unknown]
    return found


def _wrong_unit(name: str, source: ColumnSource) -> list[str]:
    quantity = source.quantity(name)
    if quantity is None:
        return [f".derive: {name} cannot be obtained by '{source.derive}'"]
    if source.factor == 0:
        return [".factor: expected a number other than 0"]
    if source.unit is None:
        return []
    known = factor_of(source.unit, quantity)
    if known is None and source.factor is None:
        measured = quantity.name.lower().replace("_", " ")
        return [
            f".unit: {source.unit!r} is not a known unit of {measured} ({_known(quantity)}); "
            f"state 'factor', {quantity} per {source.unit}"
        ]
    if known is not None and source.factor is not None:
        return [
            f".factor: {source.unit!r} is a known unit ({known:.6g} {quantity}); remove "
            "'factor', or use another label as the unit"
        ]
    return []


def _known(quantity: MeasuredQuantity) -> str:
    return ", ".join(list(UNITS[quantity])[:6]) + " ..."


def _plain_name(file: str) -> bool:
    try:
        refuse_no_file_name("file", file)
    except InvalidValue:
        return False
    return ":" not in file and file.lower().endswith(".csv")
