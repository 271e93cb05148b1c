"""docs/import.md: its fields are those that are read, its example is what the command does."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from diagnosis.lab_files.draft_file import loop_lines, mapping_text
from diagnosis.lab_files.guesses.draft import drafted
from diagnosis.lab_files.mapping import (
    ColumnSource,
    ImportMapping,
    TimeSource,
    TrialSource,
)
from diagnosis.lab_files.read_mapping import read_mapping
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.units import MeasuredQuantity, factor_of
from diagnosis.lab_files.write_log import imported, write_log
from diagnosis.log.rig_log import read_rig_log
from sim.files import Destination

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "import.md").read_text()
LAB = ROOT / "examples" / "lab"
RUNS = [LAB / "run_a.csv", LAB / "run_b.csv"]
SOURCES = (("trial_01.csv", 8), ("trial_03.csv", 4))
TORQUE_ZERO_N_M, MOTOR_ZERO_RAD = 0.0002, 0.5


@pytest.fixture(scope="module")
def draft():
    return drafted(read_lab_files(RUNS))


def first_cells(text):
    """Names in code marks of the first cells of all tables in a text."""
    cells = [line.split("|")[1] for line in text.splitlines() if line.startswith("|")]
    return {name for cell in cells for name in re.findall(r"`(\w+)`", cell)}


def test_every_field_of_a_mapping_is_on_the_page():
    section = PAGE.split("\n## mapping.yaml\n")[1].split("\n## ")[0]
    whole, rest = section.split("Each of `trials`:")
    trials, columns = rest.split("Each of `times` has")
    assert first_cells(whole) == set(ImportMapping.model_fields)
    assert first_cells(trials) == set(TrialSource.model_fields)
    assert first_cells(columns) == set(ColumnSource.model_fields)
    assert all(f"`{name}`" in columns.split("\n")[0] + columns for name in TimeSource.model_fields)


def test_every_unit_that_the_page_names_is_known():
    line = PAGE.split("Known units")[1].split(":", 1)[1].split(". Counts")[0]
    groups = [group.replace("\n", " ") for group in line.split(";")]
    order = ("ANGLE", "ANGULAR_RATE", "TORQUE", "LENGTH", "SPEED", "TIME")
    assert len(groups) == len(order)
    for name, group in zip(order, groups, strict=True):
        for unit in group.replace("(either order)", "").split(","):
            assert factor_of(unit.strip(), MeasuredQuantity[name]), unit


def test_the_example_is_a_log_of_this_repository_in_other_units():
    for run, (name, step) in zip(RUNS, SOURCES, strict=True):
        known = pd.read_csv(ROOT / "examples" / "rig-log-dry" / name).iloc[::step]
        (table,) = read_lab_files([run])[0].tables
        columns = table.columns
        for column, exact, last_digit in (
            ("time (ms)", 1000 * known["time_s"], 1),
            ("motor (rad)", np.radians(known["base_angle_deg"]) + MOTOR_ZERO_RAD, 1e-5),
            ("torque [N m]", TORQUE_ZERO_N_M - known["base_torque_n_mm"] / 1000, 1e-7),
            ("tip camera (deg)", known["tip_angle_deg"], 1e-3),
            ("slide speed (cm/s)", known["speed_mm_s"] / 10, 1e-2),
            ("free shaft (mm)", known["free_mm"], 1e-3),
        ):
            np.testing.assert_allclose(columns[column], exact, atol=0.501 * last_digit, err_msg=column)


def test_the_lines_shown_are_those_of_the_example():
    lines = PAGE.split("```\n")[1].splitlines()
    assert lines == RUNS[0].read_text().splitlines()[: len(lines)]


def test_the_draft_is_as_the_page_shows_it(draft):
    shown = PAGE.split("```yaml\n")[1].split("```")[0]
    assert shown in mapping_text(draft)
    for item in draft.open:
        assert f"to fill in: {item}" in PAGE
    for line in loop_lines(draft):
        assert f"loops: {line}" in PAGE


def test_the_reasons_on_the_page_are_those_of_the_draft(draft):
    said = {reason for column in draft.columns for reason in column.reasons.values()}
    table = PAGE.split("| column | field | guess | because |\n")[1].split("\n\n")[0]
    reasons = [line.split("|")[4].strip() for line in table.splitlines()[1:]]
    assert len(reasons) == 6
    assert set(reasons) <= said


def test_the_edited_mapping_gives_the_log_of_this_repository(tmp_path):
    """To the last digits of the lab's files: 1e-5 rad, 1e-7 N m; the motor's zero is a guess."""
    mapping = read_mapping(LAB / "mapping.yaml", accept_guesses=False)
    write_log(mapping, imported(mapping, read_lab_files(RUNS)), Destination(folder=tmp_path / "log"))
    log = read_rig_log(tmp_path / "log")
    assert log.warnings == ()
    shift = np.degrees(mapping.columns["base_angle_deg"].zero - MOTOR_ZERO_RAD)
    for trial, (name, step) in zip(log.trials, SOURCES, strict=True):
        known = pd.read_csv(ROOT / "examples" / "rig-log-dry" / name).iloc[::step]
        np.testing.assert_allclose(trial["base_angle_deg"] + shift, known["base_angle_deg"], atol=4e-4)
        np.testing.assert_allclose(trial["base_torque_n_mm"], known["base_torque_n_mm"], atol=6e-5)
        for same in ("tip_angle_deg", "free_mm", "inserted_mm", "speed_mm_s"):
            np.testing.assert_allclose(trial[same], known[same], atol=6e-4, err_msg=same)
