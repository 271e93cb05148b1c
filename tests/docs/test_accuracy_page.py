"""docs/accuracy.md lists the effects outside the library as the independent rig has them."""

from pathlib import Path

from validation.rig.unmodelled.library import EFFECTS

PAGE = Path(__file__).parents[2] / "docs" / "accuracy.md"


def test_every_effect_outside_is_on_the_page_with_its_place_and_variables():
    text = PAGE.read_text().split("\n### Effects outside the library\n")[1].split("\n### ")[0]
    lines = [line.replace("\\|", "") for line in text.splitlines() if line.startswith("| `")]
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines]
    told = {name.strip("`"): (place, on.replace("`", "")) for name, _, place, on in rows}
    known = {n: (", ".join(e.place), ", ".join(e.variables)) for n, e in EFFECTS.items()}
    assert [*told.items()] == [*known.items()]
    assert f"one of {len(EFFECTS)} [effects outside it]" in PAGE.read_text()
