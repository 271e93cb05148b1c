"""Logs that are nearly good: one or two changes to a small one, and changes that mean nothing."""

import functools
import io
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from analytic_log import RIG, SLIDES, TURNS
from fuzz.mutations import cells, changed_bytes, changed_lines, yaml_values
from fuzz.outcome import outcome
from hypothesis import strategies as st

from diagnosis.log.rig_log import read_rig_log
from diagnosis.prepare.prepare import prepare

GOOD = {
    "turns.csv": TURNS.iloc[::10].to_csv(index=False),
    "slides.csv": SLIDES.iloc[::10].to_csv(index=False),
    "rig.yaml": yaml.safe_dump(RIG, sort_keys=False),
}
COLUMNS = list(TURNS.columns)
OTHER_NAMES = ["t", "Tip Angle [rad]", "tip_angle_rad", "torque", "", "time_ms", "$x$", "tip_angle_deg "]
FACTORS = [-1.0, 1e-3, 1e3, 1 / 60, 1e-6, 57.3, 1 / 57.3, 0.0, 1e9, 360.0, 0.1, 25.4]


def read(files):
    """A log of these files, prepared; its tables and warnings."""
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        for name, content in files.items():
            data = content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass")
            Path(folder, name).write_bytes(data)
        log = read_rig_log(Path(folder))
        ready, _ = prepare(log)
        assert all(np.isfinite(trial.base_motion_deg).all() for trial in ready.trials)
    return log


@functools.cache
def good():
    """The log that all others are changes of."""
    return read(GOOD)


def checked(files, *, same=False):
    """Outcome of a log; one that means the same has to be the same."""

    def action():
        log = read(files)
        if same:
            assert log.rig == good().rig
            for own, right in zip(log.trials, good().trials, strict=True):
                pd.testing.assert_frame_equal(own.table, right.table, check_exact=True)
        return log.warnings

    return outcome(action, names=[*files, "fuzz-"], same=same, expected=good().warnings)


@st.composite
def tables(draw):
    """A trial with other cells, columns, rows, units or order."""
    name = draw(st.sampled_from(["turns.csv", "slides.csv"]))
    table = pd.read_csv(io.StringIO(GOOD[name]), dtype=object)
    for _ in range(draw(st.integers(1, 2))):
        table = draw(changed_tables(table))
    text = table.to_csv(index=False, sep=draw(st.sampled_from([",", ",", ",", ";", "\t", " "])))
    return {**GOOD, name: text}


@st.composite
def changed_tables(draw, table):
    """One change."""
    rows, columns = len(table), list(table.columns)
    column = draw(st.sampled_from(columns)) if columns else None
    row = draw(st.integers(0, max(rows - 1, 0)))
    kinds = [
        "cell",
        "cell",
        "scale",
        "swap",
        "drop",
        "rename",
        "rows",
        "order",
        "pause",
        "same",
        "offset",
    ]
    kind = draw(st.sampled_from(kinds))
    if column is None or not rows or columns.count(column) > 1:
        return table
    number = pd.to_numeric(table[column], errors="coerce")
    match kind:
        case "cell":
            last = row + draw(st.sampled_from([0, 0, 3, 60, rows]))
            table[column] = table[column].astype(object)
            table.loc[row:last, column] = draw(cells)
        case "scale":
            table[column] = number * draw(st.sampled_from(FACTORS))
        case "offset":
            table[column] = number + draw(st.sampled_from([1e-3, 10.0, -10.0, 1e6, 1.7e9, 360.0]))
        case "same":
            table[column] = table[draw(st.sampled_from(columns))]
        case "swap":
            other = draw(st.sampled_from(columns))
            table = table.rename(columns={column: other, other: column})
        case "drop":
            table = table.drop(columns=column)
        case "rename":
            table = table.rename(columns={column: draw(st.sampled_from([*OTHER_NAMES, *COLUMNS]))})
        case "rows":
            table = table.iloc[draw(st.sampled_from([slice(0, row), slice(row, None), slice(0, 25)]))]
        case "order":
            order = draw(st.sampled_from(["reverse", "shuffle", "repeat"]))
            at = {"reverse": np.arange(rows)[::-1], "repeat": np.sort(np.r_[np.arange(rows), row])}
            table = table.iloc[at.get(order, np.random.default_rng(row).permutation(rows))]
        case "pause":
            length_s = draw(st.sampled_from([0.3, 5.0, 300.0, 1e4, 1e6, 1e10, -5.0]))
            if "time_s" in table and columns.count("time_s") == 1:
                time_s = pd.to_numeric(table["time_s"], errors="coerce")
                table["time_s"] = time_s + length_s * (np.arange(rows) > row)
    return table.reset_index(drop=True)


ENCODINGS = ["utf-16", "utf-32", "cp037", "latin-1"]
encoded = st.tuples(st.sampled_from(list(GOOD)), st.sampled_from(ENCODINGS)).map(
    lambda pick: {**GOOD, pick[0]: ("é" + GOOD[pick[0]]).encode(pick[1], "replace")}
)
broken = st.sampled_from(list(GOOD)).flatmap(
    lambda name: changed_bytes(GOOD[name].encode()).map(lambda data: {**GOOD, name: data})
)
rigs = changed_lines(GOOD["rig.yaml"], yaml_values).map(lambda text: {**GOOD, "rig.yaml": text})
missing = st.sampled_from(list(GOOD)).map(lambda name: {k: v for k, v in GOOD.items() if k != name})
doubled = st.just({**GOOD, "slides.csv": GOOD["turns.csv"]})
wrong = st.one_of(tables(), tables(), tables(), broken, rigs, rigs, encoded, missing, doubled)


def _by_cells(change):
    def changed(text):
        rows = [line.split(",") for line in text.splitlines()]
        return "\n".join(",".join(change(row, i == 0)) for i, row in enumerate(rows)) + "\n"

    return changed


# Applied in this order: cells first, then lines, then the whole text.
MEANINGLESS = {
    "other order": _by_cells(lambda row, _: row[::-1]),
    "another order": _by_cells(lambda row, _: row[3:] + row[:3]),
    "a column of numbers": _by_cells(lambda row, head: [*row, "mood" if head else "7"]),
    "a column of text": _by_cells(lambda row, head: ["note" if head else "a b", *row]),
    "quotation marks": _by_cells(lambda row, _: [f'"{cell}"' for cell in row]),
    "blanks": _by_cells(lambda row, _: [f"  {cell}" for cell in row]),
    "empty lines at the end": lambda text: text + "\n\n",
    "line ends of Windows": lambda text: text.replace("\n", "\r\n"),
    "no line end at the end": lambda text: text.rstrip("\r\n"),
    "byte order mark": lambda text: "\ufeff" + text,
}


@st.composite
def same(draw):
    """The good log, written otherwise."""
    files = dict(GOOD)
    for name in draw(st.sets(st.sampled_from(["turns.csv", "slides.csv"]), min_size=1)):
        chosen = draw(st.sets(st.sampled_from(list(MEANINGLESS)), min_size=1, max_size=4))
        for change in (one for one in MEANINGLESS if one in chosen):
            files[name] = MEANINGLESS[change](files[name])
    flow = draw(st.sampled_from([None, True, False]))
    order = draw(st.permutations(list(RIG)))
    content = {name: RIG[name] for name in order}
    files["rig.yaml"] = draw(st.sampled_from(["", "\ufeff", "# a rig\n"])) + yaml.safe_dump(
        content, sort_keys=False, default_flow_style=flow
    )
    return files
