"""The files of `needle validate`."""

import json
import math

import matplotlib.image
import pytest

from models.errors import OutputExists
from sim.files import Destination
from studies.crosscheck.findings import Check, Comparison, Findings, Pole, PoleSource
from studies.crosscheck.report import FILES, output_paths, write_report

CASE = {"length_mm": 50.0, "free_mm": 0.0, "drive": "angle", "bound": 0.005}
FINDINGS = Findings(
    poles=[
        Pole(**CASE, mode=m, measured=-1.001 * m, closed_form=-float(m), source=source)
        for source in (PoleSource.SECOND_ORDER, PoleSource.NATIVE)
        for m in (1, 2, 3, 4)
    ],
    checks=[Check(name="c", value=2.0, unit="-", high=1)],
    comparisons=[
        Comparison(item="never", published=1.0, ours=math.nan, unit="s", source="here"),
        Comparison(item="half", published=2.0, ours=1.0, unit="s", source="there"),
    ],
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A report, written once: its picture simulates sixteen turns."""
    folder = tmp_path_factory.mktemp("report") / "v"
    written = write_report(FINDINGS, Destination(folder=folder))
    assert written.made == output_paths(folder) == [folder / name for name in FILES]
    return folder


def test_the_json_is_complete_and_strict(folder):
    text = (folder / "validate.json").read_text()
    content = json.loads(text, parse_constant=lambda c: pytest.fail(c))
    assert content["passed"] is False
    assert set(content["poles"][0]) == {*CASE, "mode", "measured", "closed_form", "source"}
    assert {pole["source"] for pole in content["poles"]} == {"second_order", "without_callbacks"}
    assert content["comparisons"][0]["ours"] is None


def test_tables_hold_what_the_json_holds(folder):
    rows = (folder / "poles.csv").read_text().splitlines()
    assert len(rows) == 1 + len(FINDINGS.poles)
    assert rows[0] == "length_mm,free_mm,drive,mode,measured,closed_form,source,bound,error"
    assert (folder / "published.csv").read_text().splitlines()[2] == "half,2.0,1.0,s,there,,0.5"
    assert (folder / "checks.csv").read_text().splitlines()[1] == "c,2.0,-,<= 1,False,"


def test_the_picture_is_not_blank(folder):
    assert matplotlib.image.imread(folder / "validate.png").std() > 0.01


def test_a_report_is_not_written_over_another(folder):
    with pytest.raises(OutputExists, match=r"validate\.json"):
        write_report(FINDINGS, Destination(folder=folder))
