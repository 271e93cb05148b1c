"""docs/gap-report.md tells every key that report.json has, and no other."""

import ast
import re
from dataclasses import fields
from pathlib import Path

import pytest
from free_forms import missing_with

from diagnosis.assessment.gap_reduction import GapReduction
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.fitting.fit_status import Termination
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.freeform.law_curve import Law
from diagnosis.report import json_report
from diagnosis.residuals.autocorrelation import Autocorrelation
from diagnosis.residuals.lead import Lead
from diagnosis.residuals.residual_breakdown import ResidualBreakdown
from diagnosis.residuals.residual_shape import ResidualShape
from diagnosis.residuals.spectrum import Spectrum
from diagnosis.selection.record import Decision, RecordEntry
from diagnosis.selection.verdicts.verdict import VerdictKind

PAGE = (Path(__file__).parents[2] / "docs" / "gap-report.md").read_text()
WRITTEN_AS_THEY_ARE = (
    *(GapReduction, Interval, ResidualBreakdown, NoiseFloor, RecordEntry),
    *(ResidualShape, Autocorrelation, Spectrum, Lead, Law),
)


def keys_of_the_report():
    """Constant keys of the dictionaries in json_report.py, and fields that it writes as they are."""
    tree = ast.parse(Path(json_report.__file__).read_text())
    dictionaries = [node for node in ast.walk(tree) if isinstance(node, ast.Dict)]
    constant = {key.value for d in dictionaries for key in d.keys if isinstance(key, ast.Constant)}
    return constant | {field.name for record in WRITTEN_AS_THEY_ARE for field in fields(record)}


def told():
    """Names in code marks, and those inside of marked objects like `{value, low}`."""
    marked = re.findall(r"`([^`\n]+)`", PAGE)
    return {name for text in marked for name in re.findall(r"[a-z_]+", text)}


def test_every_key_of_the_report_is_on_the_page():
    assert keys_of_the_report() - told() == set()


def test_every_verdict_status_and_decision_is_on_the_page():
    values = [*VerdictKind, *Termination, *Decision]
    assert [value for value in values if f"`{value}`" not in PAGE] == []


def test_the_first_column_of_the_tables_has_no_key_that_the_report_lacks():
    tables = PAGE.split("## report.json")[1].split("## An example")[0]
    first = re.findall(r"^\| (`[^|]+) \|", tables, flags=re.MULTILINE)
    listed = {name for cell in first for name in re.findall(r"`([a-z_]+)`", cell)}
    assert listed - keys_of_the_report() == set()
    assert len(listed) > 30


@pytest.mark.parametrize(
    ("heading", "keys"),
    [
        ("`missing` is there only", json_report._missing(missing_with()).keys()),
        ("`missing.depends_on`", json_report._missing(missing_with())["depends_on"][0].keys()),
        ("`missing.law`", json_report._missing(missing_with())["law"].keys()),
    ],
)
def test_a_table_of_what_is_missing_has_the_keys_of_its_own_object(heading, keys):
    table = re.search(r"^\| key.*?(?=\n\n)", PAGE[PAGE.index(heading) :], re.MULTILINE | re.DOTALL)[0]
    first = re.findall(r"^\| (`[^|]+) \|", table, flags=re.MULTILINE)
    assert {name for cell in first for name in re.findall(r"`([a-z_]+)`", cell)} == {*keys}
