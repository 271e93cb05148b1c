"""docs/diagnosis.md tells the stages of the search and the families of free-form laws that there are."""

import math
import re
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered

from diagnosis.criteria.freeform import FLOOR, FREEDOM, PATIENCE
from diagnosis.effects import FITTED
from diagnosis.freeform import families as folder
from diagnosis.freeform.search import CONTENDERS, FINALISTS
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.variables import Variable
from diagnosis.selection.search import STAGES

PAGE = (Path(__file__).parents[2] / "docs" / "diagnosis.md").read_text()
SECTION = PAGE.split("## When nothing explains the log")[1].split("\n## ")[0]
FILES = [name.removeprefix(f"{folder.__name__}.").replace(".", "/") for name in folder.files()]


def told():
    """Variables by file; a row without a file belongs to that of the row before."""
    found, file = {}, ""
    for row in re.findall(r"^\| (.*) \|$", SECTION, flags=re.MULTILINE)[1:]:
        first, _, third = row.split(" | ") if not row.startswith("| ") else ("", *row[2:].split(" | "))
        file = first.strip("`").removesuffix(".py") or file
        found.setdefault(file, set()).update(re.findall(r"`([a-z_]+)`", third))
    return found


def test_every_file_of_families_is_in_the_table_and_no_other():
    assert sorted(told()) == FILES


def three_times(ranges):
    """Ranges of a log whose only trial was made three times."""
    (trial,) = ranges.problem.log.trials
    trials = tuple(replace(trial, name=f"trial_{i}.csv") for i in (1, 2, 3))
    problem = replace(ranges.problem, log=replace(ranges.problem.log, trials=trials))
    left = {sensor: 3 * own for sensor, own in ranges.left.items()}
    return replace(ranges, problem=problem, nominal=3 * list(ranges.nominal), left=left)


@pytest.mark.parametrize("file", FILES)
def test_the_variables_of_its_families_are_in_the_row_and_no_other(file):
    angle = turns()
    one = covered(angle, tip=angle + 1.0, torque=0.01 * angle, seen=(angle, np.zeros(angle.size)))
    softer = [Prediction(tip_angle_deg=0.9 * angle, base_torque_n_mm=0.01 * angle)]
    every = replace(three_times(one), ends=dict.fromkeys(Variable, (0.1, 1.0)), softer=3 * softer)
    own = import_module(f"{folder.__name__}.{file.replace('/', '.')}").families(every)
    assert own
    found = {match[1] for f in own if (match := re.search(r" over ([a-z_]+)", f.name))}
    assert found == told()[file]


def test_the_numbers_of_search_and_ranking_are_those_of_the_code():
    words = {4: "four", 6: "six"}
    for said in (
        f"[(g² − {1 - FLOOR:g}) (r² − {1 - FLOOR:g})]^(−{1 / PATIENCE:g}) e^(−freedom / {FREEDOM:g})",
        f"the best {words[CONTENDERS]} to their",
        f"the best {words[FINALISTS]} are fitted to the full log",
    ):
        assert said in " ".join(SECTION.split())


def test_every_stage_of_the_search_has_a_row_of_the_table():
    search = PAGE.split("\n## Search\n")[1].split("\n## ")[0]
    first = ", ".join(re.findall(r"^\| ([^|]*) \|", search, flags=re.MULTILINE))
    rows = {name.removeprefix("then ").removeprefix("again ") for name in re.split(r"[,;] ", first)}
    assert {stage.__name__.replace("_", " ") for stage in STAGES} <= rows


def test_the_choice_among_candidates_costs_what_the_page_says():
    single, pair, triple = (math.comb(len(FITTED), size) for size in (1, 2, 3))
    said = (
        f"2 log {single} for a single effect, 2 log {pair} for a pair, 2 log {triple} for three effects"
    )
    assert said in " ".join(PAGE.split())
