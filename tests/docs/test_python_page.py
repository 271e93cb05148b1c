"""The Python of docs/python.md runs as written; diagnoses are cut short, and fewer."""

import json
import re
from pathlib import Path

import pandas as pd
import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "python.md").read_text()
MOST_LINES = 6  # beside imports
# What differs from the page: one log, and limits that a busy machine does not reach.
SHORTER = {"limit_s=60": "limit_s=600", "count=2": "count=1"}


def blocks(heading):
    """Python below a heading."""
    section = PAGE.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    return re.findall(r"```python\n(.*?)```", section, flags=re.DOTALL)


def ran(code, tmp_path, monkeypatch):
    """Names that the code defines, run in a folder that has the examples."""
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    for written, shorter in SHORTER.items():
        code = code.replace(written, shorter)
    names = {}
    exec(code, names)
    return names


def test_each_thing_that_people_do_takes_a_few_lines():
    for heading in ("Simulate", "Validate", "Control", "Import and diagnose", "Score"):
        for block in blocks(heading):
            work = [
                line for line in block.splitlines() if line and not line.startswith(("from", "import"))
            ]
            assert 2 <= len(work) <= MOST_LINES, heading


def test_simulate(tmp_path, monkeypatch):
    names = ran(blocks("Simulate")[0], tmp_path, monkeypatch)
    assert names["lag_deg"].max() > 10  # Fig. 5: a fast turn outruns the tip
    assert (tmp_path / "out" / "fig5-10cm.csv").is_file()
    assert "base_torque_n_mm" in names["recording"]._repr_html_()


@pytest.mark.slow
def test_validate(tmp_path, monkeypatch):
    names = ran(blocks("Validate")[0], tmp_path, monkeypatch)
    content = json.loads((tmp_path / "out" / "validate" / "validate.json").read_text())
    assert content["passed"] is True
    for source in ("second_order", "without_callbacks"):
        assert sum(p["source"] == source for p in content["poles"]) == 48
    assert {p["drive"] for p in content["poles"]} == {"torque", "angle"}
    assert "every bound holds" in names["findings"]._repr_html_()


def test_control(tmp_path, monkeypatch):
    names = ran(blocks("Control")[0], tmp_path, monkeypatch)
    assert abs(names["error_deg"][-1]) < 3.0  # the paper's bound on settling
    assert "wanted_tip_deg" in names["recording"]._repr_html_()


@pytest.mark.slow
def test_control_of_several(tmp_path, monkeypatch):
    table = ran(blocks("Control")[1], tmp_path, monkeypatch)["table"].set_index("controller")
    assert table["settle_s"].idxmin() == "least_time"
    assert "least_time" in table._repr_html_()


@pytest.mark.slow
@pytest.mark.usefixtures("out_of_time_after_the_nominal_replay")
def test_import_and_diagnose(tmp_path, monkeypatch):
    names = ran(blocks("Import and diagnose")[0], tmp_path, monkeypatch)
    shown = names["found"]._repr_html_()
    assert names["found"].verdict.kind.value in shown
    assert (tmp_path / "out" / "lab-report" / "report.html").is_file()


@pytest.mark.slow
@pytest.mark.usefixtures("out_of_time_after_the_nominal_replay")
def test_score(tmp_path, monkeypatch):
    scores = ran(blocks("Score")[0], tmp_path, monkeypatch)["scores"]
    assert list(scores.index) == ["case_001"]
    evil = pd.concat([scores, scores.rename(index={"case_001": "<script>"})])
    assert "<script>" not in evil._repr_html_()
