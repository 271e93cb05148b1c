"""The files of `needle validate`."""

import json
import math

import pytest

from models.errors import OutputExists
from studies.crosscheck.findings import Check, Comparison, Findings, Pole
from studies.crosscheck.report import FILES, write_report


@pytest.fixture
def measured():
    case = {"length_mm": 50.0, "free_mm": 0.0, "drive": "angle"}
    return [Pole(**case, mode=m, measured=-1.001 * m, closed_form=-float(m)) for m in (1, 2, 3, 4)]


def test_the_report_is_complete_and_strict_json(tmp_path, measured):
    findings = Findings(
        poles=measured,
        checks=[Check(name="c", value=2.0, unit="-", high=1)],
        comparisons=[Comparison(item="never", published=1.0, ours=math.nan, unit="s", source="here")],
    )
    paths = write_report(findings, tmp_path / "v")
    assert [p.name for p in paths] == list(FILES)
    content = json.loads(paths[0].read_text(), parse_constant=lambda c: pytest.fail(c))
    assert content["passed"] is False
    assert set(content["poles"][0]) == {
        "length_mm",
        "free_mm",
        "drive",
        "mode",
        "measured",
        "closed_form",
    }
    assert content["comparisons"][0]["ours"] is None
    with pytest.raises(OutputExists):
        write_report(findings, tmp_path / "v")


def test_tables_hold_what_the_json_holds(tmp_path, measured):
    comparison = Comparison(item="x", published=2.0, ours=1.0, unit="s", source="here")
    findings = Findings(poles=measured, comparisons=[comparison])
    paths = {path.name: path for path in write_report(findings, tmp_path / "v")}
    assert len(paths["poles.csv"].read_text().splitlines()) == 1 + len(measured)
    assert paths["published.csv"].read_text().splitlines()[1] == "x,2.0,1.0,s,here,,0.5"
