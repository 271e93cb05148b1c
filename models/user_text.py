r"""The user's own text (names, descriptions, paths), shown as what it says and nothing else.

Whoever shows text reads marks in it: matplotlib takes `$...$` for mathematics, Markdown `[x](y)` for a
link, XML `--` for the end of a comment, a terminal the character 27 for a command. Each has its owner
here, but HTML (`html.escape`) and rich, whose consoles are made in one place (`scripts/terminal.py`).
"""

import re

# Controls but line ends and tabs, marks that turn the direction of writing, and halves of characters.
_UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
_MARKDOWN = re.compile(r"([\\`*\[\]<>#|~$&]|(?<!\w)_|_(?!\w))")
_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"


def unprintable(text: str) -> str:
    """The first character that no page and no terminal can show; empty if there is none."""
    found = _UNPRINTABLE.search(text)
    return found[0] if found else ""


def printable(text: str) -> str:
    """The text with a mark in the place of every character that cannot be shown."""
    return _UNPRINTABLE.sub(_REPLACEMENT, text)


def in_figure(text: str) -> str:
    r"""For matplotlib: `$\foo$` is shown as it stands, and not read as mathematics."""
    return printable(text).replace("$", r"\$")


def in_markdown(text: str) -> str:
    """For a line of Markdown: no heading, link, picture, code or table of its own."""
    return _MARKDOWN.sub(r"\\\1", " ".join(printable(text).split()))


def in_xml_comment(text: str) -> str:
    """For a comment of XML, which two hyphens may end."""
    return re.sub("-(?=-|$)", "- ", printable(text))
