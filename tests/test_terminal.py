"""The command's consoles show text as it stands."""

import io

import pytest
from rich.console import Console
from rich.errors import MarkupError
from rich.table import Table
from rich.text import Text

from scripts.terminal import Terminal, terminal

TEXTS = ["o[/x]", "see [/b]", "[red]a[/red]", ":bomb:", r"\[b]", "[link=http://a]b[/link]", "Nädel 針"]


def shown(text):
    file = io.StringIO()
    console = Terminal(file=file, width=200, markup=False, emoji=False)
    table = Table("name", title=text)
    table.add_row(text)
    console.print(table)
    console.print(f"wrote {text}")
    console.print(Text(text, "bold"))
    return file.getvalue()


@pytest.mark.parametrize("text", TEXTS)
def test_marks_in_text_are_shown_in_titles_cells_and_lines(text):
    assert shown(text).count(text) == 4


def test_a_console_of_rich_reads_them():
    """Negative control."""
    with pytest.raises(MarkupError):
        Console(file=io.StringIO()).print("o[/x]")


@pytest.mark.parametrize("character", ["\x1b", "\x07", "\x9b", "\ud800"])
def test_a_terminal_is_sent_no_control_of_a_users_text(character):
    found = shown(f"a{character}[31mb")
    assert character not in found
    assert "a\N{REPLACEMENT CHARACTER}[31mb" in found or character == "\x07"


def test_results_and_errors_go_to_their_own_streams():
    assert (terminal().stderr, terminal(stderr=True).stderr) == (False, True)
