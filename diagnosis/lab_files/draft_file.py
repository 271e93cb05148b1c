"""A draft as the text of `mapping.yaml`: guesses with their reasons, blanks for what is unknown."""

import json
from collections.abc import Iterator
from typing import Any

from diagnosis.lab_files.guesses.draft import NOISES, Draft
from diagnosis.lab_files.guesses.guessed import GuessedColumn
from diagnosis.log.nominal_rig import NominalInertia, NominalNeedle, NominalTissue
from diagnosis.log.trial import REQUIRED, SENSORS

_HEAD = """\
# Draft of a mapping by `needle import`. No guess in it is used before you have confirmed it.
#   1. look at preview.png
#   2. check each entry, then delete its line 'guess: true'
#   3. fill every blank (each line that ends in ':')
#   4. needle import FILE... --map THIS_FILE --out LOG
# rig-log value = sign * factor * (value in the file - zero); docs/import.md has every field.
"""


def mapping_text(draft: Draft) -> str:
    """The YAML of a draft."""
    parts = [_HEAD, "format: rig-import/1\n"]
    if draft.open:
        parts.append("# Open:\n" + "".join(f"#   - {_one_line(item)}\n" for item in draft.open))
    parts += ["".join(_trials(draft)), "".join(_times(draft)), "".join(_columns(draft))]
    parts += ["".join(_constants(draft)), "".join(_rig(draft))]
    return "\n".join(part for part in parts if part)


def _trials(draft: Draft) -> Iterator[str]:
    yield "trials:\n"
    for trial in draft.trials:
        files = ", ".join(_value(name) for name in trial.lab_files)
        yield f"  - file: {_value(trial.file)}\n    lab_files: [{files}]\n"
        yield "    constants: {}  # of this trial alone, e.g. {inserted_mm: 100}\n"
        if trial.guess:
            yield "    guess: true  # do these files belong together?\n"


def _times(draft: Draft) -> Iterator[str]:
    yield "times:\n" if draft.times else "times: []\n"
    for time in draft.times:
        yield _line("  - column", time.source.column, time.because)
        yield _line("    unit", time.source.unit, time.reason)
        if time.source.guess:
            yield "    guess: true\n"
    if not draft.times:
        yield _line("sample_hz", None, "samples per second, if they are evenly spaced")
    reason = (
        "rows per second; these columns have clocks of their own"
        if draft.resample_hz
        else ("rows per second; without it, rows are written unchanged")
    )
    yield _line("resample_hz" if draft.resample_hz else "# resample_hz", draft.resample_hz, reason)


def _columns(draft: Draft) -> Iterator[str]:
    yield "columns:\n"
    if "base_angle_deg" not in {column.wanted for column in draft.columns}:
        yield "  base_angle_deg:\n" + _line("    column", None, "which one?") + "    unit:\n"
    for column in draft.columns:
        yield from _column(column)
    for one in draft.tip_candidates:
        unit = f", unit: {_value(one.unit)}" if one.unit else ""
        entry = f"{{column: {_value(one.column)}{unit}, sign: {one.sign}}}"
        yield f"  # tip_angle_deg: {entry}  # {_one_line(one.reason)}\n"
    if draft.unused:
        yield "# not used: " + ", ".join(map(repr, draft.unused)) + "\n"


def _column(column: GuessedColumn) -> Iterator[str]:
    source, reasons = column.source, column.reasons
    yield f"  {column.wanted}:\n"
    yield _line("    column", source.column, reasons["column"])
    yield _line("    unit", source.unit, reasons["unit"])
    if source.unit is not None and not column.known:
        yield _line("    factor", None, f"{source.quantity(column.wanted)} per {source.unit}")
    if source.derive:
        yield _line("    derive", source.derive, reasons["derive"])
    yield _line("    sign", source.sign, reasons.get("sign", "unchanged"))
    yield _line("    zero", source.zero, reasons.get("zero", "not estimated"))
    yield _line("    time_offset_s", source.time_offset_s, reasons.get("time_offset_s", "not estimated"))
    yield "    guess: true\n"


def _constants(draft: Draft) -> Iterator[str]:
    have = {"time_s", "base_angle_deg", *(column.wanted for column in draft.columns)}
    missing = [name for name in REQUIRED if name not in have]
    yield "constants:\n" if missing else "constants: {}\n"
    for name in missing:
        yield _line(f"  {name}", None, "a number for all rows, or a column above")


def _rig(draft: Draft) -> Iterator[str]:
    """Lines for needle and tissue, left blank: no log contains the nominal constants of its rig."""
    for section, record in (("needle", NominalNeedle), ("tissue", NominalTissue)):
        yield f"{section}:\n" + "".join(f"  {name}:\n" for name in record.model_fields)
    zeros = ", ".join(f"{name}: 0.0" for name in NominalInertia.model_fields)
    yield f"# inertia: {{{zeros}}}  # of what turns with the shaft, if it is more than a bare needle\n"
    yield "sensors:\n"
    have = {column.wanted for column in draft.columns}
    for name, value in draft.noise.items():
        if NOISES[name] not in have and NOISES[name] in SENSORS:
            yield _line(f"  {name}", 1.0, "this sensor is not there: any number will do")
        else:
            told = value is not None or name in draft.noise_in_files
            reason = (
                "scatter of the readings, at rest if there is a rest" if told else "not read: fill in"
            )
            times = f"times the factor: {draft.noise_in_files.get(name)} is the scatter of the readings"
            yield _line(f"  {name}", value, times if name in draft.noise_in_files else reason)
    if draft.loops is not None:
        yield "# What the loops of torque over angle look like (docs/import.md#the-loops):\n"
        yield "".join(f"#   {line}\n" for line in loop_lines(draft))


def loop_lines(draft: Draft) -> list[str]:
    """Stiffness, play and dry level of the loops, in words."""
    if draft.loops is None:
        return []
    angle, torque = draft.loop_units
    shape = draft.loops
    return [
        f"stiffness after a reversal: {shape.stiffness.told(f'{torque}/{angle}')}",
        f"play (flat part after a reversal): {shape.play.told(angle)}",
        f"level (half of the loop's width): {shape.level.told(torque)}, at "
        f"{shape.rates_per_s[0]:.3g} to {shape.rates_per_s[1]:.3g} {angle}/s, viscous torque included",
        f"torque that remains at rest after a turn (dry friction only): {shape.kept.told(torque)}",
        f"middle of the loops (an offset of the torque sensor?): {shape.middle.told(torque)}",
    ]


def _line(name: str, value: Any, reason: str) -> str:
    shown = "" if value is None else f" {_value(value)}"
    comment = f"  # {_one_line(reason)}" if reason else ""
    return f"{name}:{shown}{comment}\n"


def _value(value: Any) -> str:
    """JSON is YAML: names with colons, brackets or quotation marks are safe."""
    return json.dumps(value, ensure_ascii=False)


def _one_line(text: str) -> str:
    return " ".join(str(text).split())
