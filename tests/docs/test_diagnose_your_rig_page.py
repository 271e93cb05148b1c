"""docs/diagnose-your-rig.md explains what the tool shows."""

import ast
from pathlib import Path

import pytest
import yaml

from diagnosis.effects import LIBRARY
from diagnosis.report import sections
from diagnosis.selection.verdicts.verdict import VerdictKind

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "diagnose-your-rig.md").read_text()
EXAMPLE = ROOT / "examples" / "rig-log-dry"


def headings_of_the_report():
    """Headings below the first, each with the marks that it has on the page: one level deeper."""
    for path in sorted(Path(sections.__file__).parent.glob("*.py")):
        for node in ast.walk(ast.parse(path.read_text())):
            called = isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "heading"
            if called and isinstance(node.args[0], ast.Constant):
                level = next((k.value.value for k in node.keywords if k.arg == "level"), 2)
                yield f"{'#' * (level + 1)} {node.args[0].value}"


def test_every_section_of_the_report_is_explained():
    headings = list(headings_of_the_report())
    assert len(headings) == 20
    assert [h for h in headings if f"\n{h}\n" not in PAGE] == []


@pytest.mark.parametrize("verdict", VerdictKind)
def test_every_verdict_is_explained(verdict):
    assert f"\n| `{verdict}` |" in PAGE


def test_the_files_shown_are_those_of_the_example():
    shown = yaml.safe_load(PAGE.split("```yaml\n")[1].split("```")[0])
    assert shown == yaml.safe_load((EXAMPLE / "rig.yaml").read_text())
    lines = PAGE.split("```csv\n")[1].split("```")[0].splitlines()
    assert lines == (EXAMPLE / "trial_01.csv").read_text().splitlines()[: len(lines)]


def test_the_number_of_effects_is_that_of_the_library():
    assert f"[{len(LIBRARY)} effects](effects.md)" in PAGE


def warnings_told():
    """First cells of the table of warnings."""
    rows = PAGE.split("\n## Warnings\n")[1].split("\n## ")[0].splitlines()
    return [row.split("|")[1].strip().strip("`") for row in rows if row.startswith("| `")]


def test_every_warning_on_the_page_is_one_that_the_code_can_give():
    """Literal parts of messages in the code; names of columns may be filled in."""
    code = "".join(path.read_text() for path in sorted((ROOT / "diagnosis").rglob("*.py")))
    assert len(warnings_told()) == 33
    assert [text for text in warnings_told() if text not in code] == []
