"""Parts of a page for people: one HTML file with its pictures inside, which opens without a network."""

import base64
import html
import io
import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from diagnosis.report.html_style import STYLE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DPI = 100
_COLOURS = 64  # of lines and letters: a third of the bytes that all colours take
_WIDE_AT = 8.5  # inches: wider pictures scroll on a phone, so that their words stay readable


def document(title: str, parts: Iterable[str]) -> str:
    """A whole page from parts that are HTML already."""
    body = "\n".join(parts)
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(title)}</title><style>{STYLE}</style></head>"
        '<body><a class="skip" href="#main">Skip to the answer</a>'
        f'<main id="main">{body}</main></body></html>\n'
    )


def heading(text: str, level: int = 2) -> str:
    """A heading; those below the first can be linked to."""
    own = "" if level == 1 else f' id="{anchor(text)}"'
    return f"<h{level}{own}>{html.escape(text)}</h{level}>"


def anchor(text: str) -> str:
    """The address of a heading within the page."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")


def contents(titles: Iterable[str]) -> str:
    """Links to the headings of the second level."""
    lines = (f'<li><a href="#{anchor(t)}">{html.escape(t)}</a></li>' for t in titles)
    return f'<nav aria-label="Contents"><strong>Contents</strong><ul>{"".join(lines)}</ul></nav>'


def paragraph(text: str, kind: str = "") -> str:
    """A paragraph of plain text; `kind` is its look in the style sheet."""
    own = f' class="{kind}"' if kind else ""
    return f"<p{own}>{html.escape(text)}</p>"


def warnings(texts: Iterable[str]) -> list[str]:
    """A box per warning."""
    return [paragraph(text, "warning") for text in texts]


def bullets(lines: Iterable[str]) -> str:
    """A list of plain text."""
    return "<ul>" + "".join(f"<li>{html.escape(line)}</li>" for line in lines) + "</ul>"


def table(head: Sequence[str], rows: Iterable[Sequence[str]], caption: str = "") -> str:
    """A table of plain text, which scrolls within itself where it is too wide.

    Args:
      caption: what it shows; empty: what stands above it says so.
    """
    cells = "".join(f'<th scope="col">{html.escape(name)}</th>' for name in head)
    body = "".join(f"<tr>{_row(row)}</tr>" for row in rows)
    told = f"<caption>{html.escape(caption)}</caption>" if caption else ""
    label = html.escape(f"Table: {caption or ', '.join(head)}")
    return (
        f'<div class="scroll" role="group" tabindex="0" aria-label="{label}"><table>{told}'
        f"<thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table></div>"
    )


def _row(cells: Sequence[str]) -> str:
    first, *others = (html.escape(cell) for cell in cells)
    return f'<th scope="row">{first}</th>' + "".join(f"<td>{cell}</td>" for cell in others)


def folded(summary: str, content: str, *, unfolded: bool = False) -> str:
    """Content that a click on its summary opens; print shows it all.

    Args:
      content: HTML already.
      unfolded: whether it is open from the beginning.
    """
    state = " open" if unfolded else ""
    return f"<details{state}><summary>{html.escape(summary)}</summary>{content}</details>"


def picture(figure: "Figure", alt: str = "") -> str:
    """A figure inside the page.

    Args:
      alt: what the picture shows, for readers who cannot see it.
    """
    width, height = (round(_DPI * side) for side in figure.get_size_inches())
    wide = " wide" if width > _DPI * _WIDE_AT else ""
    data = base64.b64encode(_png(figure)).decode()
    image = (
        f'<img alt="{html.escape(alt)}" width="{width}" height="{height}" '
        f'src="data:image/png;base64,{data}">'
    )
    return f'<figure class="scroll{wide}" tabindex="0" aria-label="Picture">{image}</figure>'


def _png(figure: "Figure") -> bytes:
    """A picture of few colours, drawn once: `savefig` would draw a second time for the layout alone."""
    from matplotlib import rc_context  # noqa: PLC0415 - takes longer than a page without pictures
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: PLC0415

    canvas: Any = FigureCanvasAgg(figure)
    figure.set_dpi(_DPI)
    with rc_context({"text.hinting": "no_hinting"}):  # hinting takes a tenth of the time
        canvas.draw()
    drawn = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    small = io.BytesIO()
    drawn.quantize(_COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(small, "png")
    return small.getvalue()
