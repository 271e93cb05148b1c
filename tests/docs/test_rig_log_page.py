"""docs/rig-log.md is the format that is read: fields, columns, ranges and the example."""

from pathlib import Path

import pytest

from diagnosis.criteria.log import NOMINAL_RANGE, READING_RANGE
from diagnosis.log.rig_yaml import read_rig
from diagnosis.log.trial import COLUMNS, REQUIRED

PAGE = (Path(__file__).parents[2] / "docs" / "rig-log.md").read_text()


def rows_below(heading):
    """Cells of the first table below a heading, by their first cell."""
    lines = PAGE.split(f"\n## {heading}\n")[1].splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("|"))
    rows = {}
    for line in lines[first + 2 :]:
        if not line.startswith("|"):
            return rows
        name, *cells = (cell.strip() for cell in line.split("|")[1:-1])
        rows[name.strip("`")] = cells
    return rows


def span(cells):
    return pytest.approx(tuple(float(end) for end in cells[-1].split(" to ")), abs=2e-6)


def test_every_constant_of_rig_yaml_is_on_the_page_with_its_range():
    rows = {name: cells for name, cells in rows_below("rig.yaml").items() if cells[-1]}
    assert set(rows) == {f"{section}.{field}" for section, field in NOMINAL_RANGE}
    for (section, field), limits in NOMINAL_RANGE.items():
        assert limits == span(rows[f"{section}.{field}"]), field


def test_every_column_is_on_the_page_with_its_range_and_whether_it_is_required():
    rows = rows_below("A trial")
    assert set(rows) == set(COLUMNS)
    for name, cells in rows.items():
        assert READING_RANGE[name] == span(cells), name
        assert cells[1] == ("yes" if name in REQUIRED else "no"), name


def test_the_rig_yaml_of_the_page_is_read(tmp_path):
    path = tmp_path / "rig.yaml"
    path.write_text(PAGE.split("```yaml\n")[1].split("```")[0])
    rig = read_rig(path)
    assert rig.needle.diameter_mm == 0.59
    assert [entry.file for entry in rig.trials] == ["trial_01.csv"]


def test_the_header_of_the_page_has_columns_of_the_format_alone():
    header = PAGE.split("```csv\n")[1].splitlines()[0].split(",")
    assert set(REQUIRED) <= set(header) <= set(COLUMNS)
