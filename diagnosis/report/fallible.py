"""Parts of a page that may fail: a sentence stands in their place, and the rest of the page stands."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from html import unescape
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVarTuple

from diagnosis.report.html_parts import document, heading, paragraph, picture
from sim.files import ResultSet, write_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Shown = TypeVarTuple("Shown")
Part = tuple[Callable[..., list[str]], *tuple[Any, ...]]
"""What makes parts of a page, and what it shows."""

_HEADING = re.compile(r"<h\d[^>]*>(.*)</h\d>")
_REST = "The rest of the page is complete without it."


@dataclass(frozen=True, kw_only=True)
class Page:
    """A page for people.

    Attributes:
      text: HTML.
      lacks: each part that could not be made, with the reason.
    """

    text: str
    lacks: tuple[str, ...]


class MissingPart(str):
    """A sentence, as HTML, in place of a part.

    Attributes:
      what: is missing.
      place: how it lies to the heading before it.
      why: it could not be made.
    """

    what: str
    place: str
    why: str

    def __new__(cls, what: str, place: str, why: str) -> "MissingPart":
        """The sentence."""
        sentence = f"The {what} for this place could not be made ({why}). {_REST}"
        part = super().__new__(cls, paragraph(sentence, "warning"))
        part.what, part.place, part.why = what, place, why
        return part

    def __getnewargs__(self) -> tuple[str, str, str]:  # type: ignore[override]
        """From which another process makes the same."""
        return self.what, self.place, self.why


def page_of(title: str, parts: Iterable[str]) -> Page:
    """A whole page from parts that are HTML already, and what is missing among them."""
    every = list(parts)
    return Page(text=document(title, every), lacks=tuple(_missing(every)))


def write_page(make: Callable[[], Page], results: ResultSet, path: Path) -> None:
    """Make a page and write it, as a result that others can stand without.

    Raises:
      OSError: the disk is at fault.
    """

    def write(draft: Path) -> None:
        made = make()
        write_text(draft, made.text)
        results.lacks[path] = made.lacks

    results.optional(path, write)


def drawn(draw: "Callable[[*Shown], Figure]", describe: Callable[[*Shown], str], *shown: *Shown) -> str:
    """A picture of what is shown, described in words; if it fails, a sentence in its place."""
    try:
        return picture(draw(*shown), describe(*shown))
    except Exception as error:
        return MissingPart("picture", "under", _in_words(error))


def section(make: Callable[[*Shown], list[str]], *shown: *Shown, title: str = "") -> list[str]:
    """The parts of a section; if it fails, a sentence in its place.

    Args:
      title: of the page, if it is this section that has it: a page has one in any case.
    """
    try:
        return make(*shown)
    except Exception as error:
        missing = MissingPart("section", "after", _in_words(error))
        return [heading(title, level=1), missing] if title else [missing]


def _in_words(error: Exception) -> str:
    return f"{type(error).__name__}: {error}".removesuffix(": ")


def _missing(parts: Iterable[str]) -> Iterator[str]:
    """What is missing, by the heading before it."""
    above = ""
    for part in parts:
        if found := _HEADING.fullmatch(part):
            above = unescape(found[1])
        if isinstance(part, MissingPart):
            where = f"{part.place} {above!r}" if above else "at the top"
            yield f"the {part.what} {where} ({part.why})"
