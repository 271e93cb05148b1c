"""A figure as a picture inside a page."""

import base64
import html
import io
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

_DPI = 100
_COLOURS = 64  # of lines and letters: a third of the bytes that all colours take
_WIDE_AT = 8.5  # inches: wider pictures scroll on a phone, so that their words stay readable


def picture(figure: Figure, alt: str = "") -> str:
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


def _png(figure: Figure) -> bytes:
    """A picture of few colours, drawn once: `savefig` would draw a second time for the layout alone."""
    canvas: Any = FigureCanvasAgg(figure)
    figure.set_dpi(_DPI)
    with rc_context({"text.hinting": "no_hinting"}):  # hinting takes a tenth of the time
        canvas.draw()
    drawn = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    small = io.BytesIO()
    drawn.quantize(_COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(small, "png")
    return small.getvalue()
