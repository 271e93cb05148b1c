r"""Escapes the user's own text (names, descriptions, paths), so that it is displayed literally.

Every display interprets some characters: matplotlib takes `$...$` for mathematics, Markdown `[x](y)`
for a link, XML `--` for the end of a comment, a terminal the character 27 for a command. This module
escapes for these; `html.escape` does for HTML, and `scripts/terminal.py` for rich.
"""

import re

# Controls but line ends and tabs, marks that turn the direction of writing, and halves of characters.
_UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
_MARKDOWN = re.compile(r"([\\`*\[\]<>#|~$&]|(?<!\w)_|_(?!\w))")
_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"


def unprintable(text: str) -> str:
    """The first character that cannot be displayed; empty if there is none."""
    found = _UNPRINTABLE.search(text)
    return found[0] if found else ""


def printable(text: str) -> str:
    """The text with a mark in place of every character that cannot be displayed."""
    return _UNPRINTABLE.sub(_REPLACEMENT, text)


def in_figure(text: str) -> str:
    r"""Escape for matplotlib: `$\foo$` is displayed literally, not as mathematics."""
    return printable(text).replace("$", r"\$")


def in_markdown(text: str) -> str:
    """Escape for a line of Markdown: the text makes no heading, link, picture, code or table."""
    return _MARKDOWN.sub(r"\\\1", " ".join(printable(text).split()))


def in_xml_comment(text: str) -> str:
    """Escape for an XML comment, which may not contain two hyphens in a row."""
    return re.sub("-(?=-|$)", "- ", printable(text))
