"""Tables at any width: nothing is cut, and no line is longer than the screen."""

import io

import pytest
from rich.console import Console
from rich.table import Table

from scripts.tables import fitted, print_table

HEADINGS = ("settling of ours", "settling of the paper", "ratio of both", "largest shear stress")


def table():
    made = Table("depth", "controller", *HEADINGS, title="Steps", caption="of ninety degrees")
    made.add_row("5", "least_time", "0.31", "0.44", "0.70", "[red]411[/]")
    made.add_row("10", "feedforward", "0.62", "1.02", "0.61", "388", end_section=True)
    return made


def printed(width, made=None, keys=2):
    console = Console(width=width, file=io.StringIO(), color_system=None)
    print_table(console, made or table(), keys=keys)
    return console.file.getvalue()


@pytest.mark.parametrize("width", [200, 100, 80, 60, 45])
def test_at_every_width_every_word_is_whole_and_no_line_too_long(width):
    text = printed(width)
    assert max(map(len, text.splitlines())) <= width
    assert "…" not in text
    words = {
        *["depth", "controller", "least_time", "feedforward", "411", "0.62", "ninety"],
        *" ".join(HEADINGS).split(),
    }
    assert words <= set(text.replace("│", " ").replace("┃", " ").split())


def test_what_fits_is_one_table_and_keeps_its_box():
    assert printed(200).count("least_time") == 1
    assert "┃" in printed(200)


def test_what_is_too_wide_is_repeated_beside_its_keys():
    text = printed(40)
    assert text.count("least_time") == text.count("feedforward") > 1
    assert "continued" in text
    assert text.count("of ninety degrees") == 1


def test_sections_stay():
    parts = fitted(Console(width=40), table(), keys=2)
    assert all([row.end_section for row in part.rows] == [False, True] for part in parts)


def test_a_word_longer_than_half_the_screen_is_broken_and_complete():
    made = Table("entity", "last")
    made.add_row("/a_name_of_an_entity_without_any_blank_in_it", "3")
    text = printed(30, made, keys=1)
    assert max(map(len, text.splitlines())) <= 30
    cells = "".join(line.split("│")[1].strip() for line in text.splitlines() if line.count("│") == 3)
    assert cells == "/a_name_of_an_entity_without_any_blank_in_it"


def test_beside_names_that_are_too_long_numbers_stay_whole():
    made = Table("entity", "component", "unit")
    made.add_row("/an_entity_without_any_blank", "A3D:component_without_blanks", "mm/s")
    text = printed(45, made, keys=2)
    assert max(map(len, text.splitlines())) <= 45
    assert "mm/s" in text
    assert "unit" in text
