"""docs/effects.md is the library: no effect, parameter, unit or bound is missing, added or different."""

from pathlib import Path

from diagnosis.effects import LIBRARY

PAGE = Path(__file__).parents[2] / "docs" / "effects.md"
SHAPE = "–"


def table_below(heading):
    """Rows of the first table below a heading, one dict per row, code marks removed."""
    lines = PAGE.read_text().split(f"\n## {heading}\n")[1].split("\n## ")[0].splitlines()
    cells = [[c.strip() for c in line.split("|")[1:-1]] for line in lines if line.startswith("|")]
    head, _, *rows = cells
    return [dict(zip(head, row, strict=True)) for row in rows]


def code(cell):
    return cell.strip("`")


def test_every_effect_of_the_library_is_on_the_page_with_place_title_and_needs():
    told = {
        code(row["effect"]): (row["place"], row["title"], code(row["contains"]), code(row["needs"]))
        for row in table_below("Effects")
    }
    assert told == {
        name: (effect.place.value, effect.title, ", ".join(effect.contains), effect.needs)
        for name, effect in LIBRARY.items()
    }


def test_every_parameter_is_on_the_page_with_its_unit_and_bounds():
    told = {
        (code(row["effect"]), code(row["parameter"])): (
            row["unit"],
            float(row["lowest"]),
            float(row["highest"]),
            None if row["absent at"] == SHAPE else float(row["absent at"]),
            row["reported"] == "yes",
        )
        for row in table_below("Parameters")
    }
    assert told == {
        (name, p.name): (p.unit, p.low, p.high, p.neutral, p.reported)
        for name, effect in LIBRARY.items()
        for p in effect.parameters
    }


def test_the_law_of_every_effect_names_each_of_its_parameters():
    for row in table_below("Effects"):
        for parameter in LIBRARY[code(row["effect"])].parameters:
            assert f"`{parameter.name}`" in row["law"], row["effect"]
