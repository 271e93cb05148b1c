"""A user's text is shown as it stands by whoever reads marks in text."""

from xml.dom.minidom import parseString

import matplotlib.pyplot as plt
import pytest

from models.user_text import in_figure, in_markdown, in_xml_comment, printable, unprintable

TEXTS = ["run_$5_and_$6.csv", r"$\foo$", "see [/b]", "# x | `y`", "![a](http://b)", "-->", "a--b", "針"]


@pytest.mark.parametrize("text", TEXTS)
def test_what_can_be_shown_stays_as_it_is(text):
    assert printable(text) == text
    assert unprintable(text) == ""


@pytest.mark.parametrize("character", ["\x1b", "\0", "\x07", "\x9b", "\x7f", "\ud800", "\u202e"])
def test_what_cannot_be_shown_is_marked(character):
    assert unprintable(f"a{character}b") == character
    assert printable(f"a{character}b") == "a\N{REPLACEMENT CHARACTER}b"


@pytest.mark.parametrize("text", [*TEXTS, "$", "$$", r"\$", r"a\\$b$"])
def test_matplotlib_draws_every_character_and_parses_none(text):
    figure, axis = plt.subplots()
    shown = axis.set_title(in_figure(text))
    assert shown._preprocess_math(shown.get_text()) == (text, False)
    plt.close(figure)


def test_without_it_matplotlib_fails():
    """Negative control."""
    figure, axis = plt.subplots()
    axis.set_title(r"$\foo$")
    with pytest.raises(ValueError, match="foo"):
        figure.draw_without_rendering()
    plt.close(figure)


@pytest.mark.parametrize("text", TEXTS)
def test_a_comment_of_xml_ends_where_it_should(text):
    document = parseString(f"<!-- {in_xml_comment(text)} --><a/>")
    assert document.documentElement.tagName == "a"


def test_markdown_of_a_users_text_has_no_marks_of_its_own():
    assert in_markdown("# a\n![b](c)") == r"\# a !\[b\](c)"
