"""Parts of a page: plain text stays plain text, and a page is for every reader."""

import base64
import io

import numpy as np
import pytest
from html_outline import HtmlOutline
from matplotlib.figure import Figure
from PIL import Image

from diagnosis.report import html_parts as html
from diagnosis.report.figures.layout import subplots

TEXT = "a < b & <script>"
SAFE = "a &lt; b &amp; &lt;script&gt;"


@pytest.mark.parametrize(
    "part",
    [
        html.heading(TEXT),
        html.paragraph(TEXT),
        html.warnings([TEXT])[0],
        html.bullets([TEXT]),
        html.table((TEXT,), [(TEXT,)], TEXT),
        html.contents([TEXT]),
        html.folded(TEXT, ""),
        html.document(TEXT, []),
    ],
)
def test_text_is_escaped(part):
    assert SAFE in part
    assert "<script>" not in part


def test_folded_content_stays_as_it_is_and_may_be_open():
    assert html.folded("Pairs", "<p>a</p>") == "<details><summary>Pairs</summary><p>a</p></details>"
    assert html.folded("Pairs", "", unfolded=True).startswith("<details open>")


def test_a_heading_has_its_level_and_can_be_linked_to():
    assert html.heading("Gap", level=1) == "<h1>Gap</h1>"
    assert html.heading("Where it is", level=3) == '<h3 id="where-it-is">Where it is</h3>'
    assert '<a href="#where-it-is">Where it is</a>' in html.contents(["Where it is"])


def test_a_paragraph_has_its_look():
    assert html.paragraph("a", "lead") == '<p class="lead">a</p>'
    assert html.warnings(["mind"]) == ['<p class="warning">mind</p>']


def test_a_table_has_a_caption_heads_of_columns_and_of_rows_and_scrolls_by_keyboard():
    found = HtmlOutline(html.table(("a", "b"), [("1", "2"), ("3", "4")], "Numbers"))
    assert found.unbalanced == []
    assert len(found.attributes("tr")) == 3
    assert [own["scope"] for own in found.attributes("th")] == ["col", "col", "row", "row"]
    assert len(found.attributes("caption")) == 1
    (box,) = found.attributes("div")
    assert (box["tabindex"], box["aria-label"]) == ("0", "Table: Numbers")


def test_a_table_without_a_caption_is_named_by_its_head():
    found = HtmlOutline(html.table(("a", "b"), [("1", "2")]))
    assert found.attributes("caption") == []
    assert found.attributes("div")[0]["aria-label"] == "Table: a, b"


@pytest.mark.parametrize(("width", "look"), [(6.0, "scroll"), (11.0, "scroll wide")])
def test_a_picture_is_inside_the_page_with_its_size(width, look):
    figure = Figure(figsize=(width, 2.0))
    found = HtmlOutline(html.picture(figure, alt="what it shows"))
    (image,), (box,) = found.attributes("img"), found.attributes("figure")
    assert image["src"].startswith("data:image/png;base64,")
    assert image["alt"] == "what it shows"
    assert (image["width"], image["height"]) == (str(round(100 * width)), "200")
    assert box["class"] == look


def test_a_picture_of_few_colours_keeps_its_white_and_its_lines():
    figure, axis = subplots(figsize=(4.0, 2.0))
    axis.plot([0, 1], color="#940f1c", lw=9)
    encoded = HtmlOutline(html.picture(figure)).attributes("img")[0]["src"].split(",")[1]
    drawn = np.asarray(Image.open(io.BytesIO(base64.b64decode(encoded))).convert("RGB"), int)
    assert np.abs(drawn[0, 0] - 255).max() <= 3
    assert (np.abs(drawn - [0x94, 0x0F, 0x1C]).max(axis=-1) <= 3).sum() > 500


def test_a_document_fits_a_phone_and_begins_with_a_way_past_its_head():
    found = HtmlOutline(html.document("Gap report", ["<p>a</p>"]))
    assert found.unbalanced == []
    assert {"name": "viewport", "content": "width=device-width, initial-scale=1"} in found.attributes(
        "meta"
    )
    assert found.attributes("html")[0]["lang"] == "en"
    (skip,) = found.attributes("a")
    assert skip["href"] == f"#{found.attributes('main')[0]['id']}"
