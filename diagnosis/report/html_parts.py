"""Parts of a page for people: one HTML file with its pictures inside, which opens without a network."""

import base64
import html
import io
from collections.abc import Iterable, Sequence

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

_STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;
color:#222}h1{font-size:1.4em}h2{font-size:1.15em;margin-top:2em}img{max-width:100%}
table{border-collapse:collapse;font-size:.9em}td,th{border-bottom:1px solid #ccc;
padding:.2em .8em;text-align:left;vertical-align:top}.warning{background:#fff3cd;padding:.5em 1em}"""


def document(title: str, parts: Iterable[str]) -> str:
    """A whole page from parts that are HTML already."""
    body = "\n".join(parts)
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        f"<title>{html.escape(title)}</title><style>{_STYLE}</style></head><body>{body}</body></html>\n"
    )


def heading(text: str, level: int = 2) -> str:
    """A heading."""
    return f"<h{level}>{html.escape(text)}</h{level}>"


def paragraph(text: str) -> str:
    """A paragraph of plain text."""
    return f"<p>{html.escape(text)}</p>"


def warnings(texts: Iterable[str]) -> list[str]:
    """A box per warning."""
    return [f'<p class="warning">{html.escape(text)}</p>' for text in texts]


def bullets(lines: Iterable[str]) -> str:
    """A list of plain text."""
    return "<ul>" + "".join(f"<li>{html.escape(line)}</li>" for line in lines) + "</ul>"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table of plain text."""
    cells = "".join(f"<th>{html.escape(name)}</th>" for name in head)
    lines = ["".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in rows]
    return f"<table><tr>{cells}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"


def picture(figure: Figure, alt: str = "") -> str:
    """A figure inside the page; it is closed.

    Args:
      alt: what the picture shows, for readers who cannot see it.
    """
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=90, format="png")
    plt.close(figure)
    data = base64.b64encode(buffer.getvalue()).decode()
    return f'<img alt="{html.escape(alt)}" src="data:image/png;base64,{data}">'
