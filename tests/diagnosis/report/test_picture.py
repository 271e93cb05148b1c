"""Pictures of a page."""

import base64
import io

import numpy as np
import pytest
from html_outline import HtmlOutline
from matplotlib.figure import Figure
from PIL import Image

from diagnosis.report.figures.layout import subplots
from diagnosis.report.picture import picture


@pytest.mark.parametrize(("width", "look"), [(6.0, "scroll"), (11.0, "scroll wide")])
def test_a_picture_is_inside_the_page_with_its_size(width, look):
    figure = Figure(figsize=(width, 2.0))
    found = HtmlOutline(picture(figure, alt="what it shows"))
    (image,), (box,) = found.attributes("img"), found.attributes("figure")
    assert image["src"].startswith("data:image/png;base64,")
    assert image["alt"] == "what it shows"
    assert (image["width"], image["height"]) == (str(round(100 * width)), "200")
    assert box["class"] == look


def test_a_picture_of_few_colours_keeps_its_white_and_its_lines():
    figure, axis = subplots(figsize=(4.0, 2.0))
    axis.plot([0, 1], color="#940f1c", lw=9)
    encoded = HtmlOutline(picture(figure)).attributes("img")[0]["src"].split(",")[1]
    drawn = np.asarray(Image.open(io.BytesIO(base64.b64decode(encoded))).convert("RGB"), int)
    assert np.abs(drawn[0, 0] - 255).max() <= 3
    assert (np.abs(drawn - [0x94, 0x0F, 0x1C]).max(axis=-1) <= 3).sum() > 500
