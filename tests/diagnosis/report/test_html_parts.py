"""Parts of a page: plain text stays plain text, and a page is for every reader."""

import pytest
from html_outline import HtmlOutline

from diagnosis.report import html_parts as html

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


def test_a_document_fits_a_phone_and_begins_with_a_way_past_its_head():
    found = HtmlOutline(html.document("Gap report", ["<p>a</p>"]))
    assert found.unbalanced == []
    assert {"name": "viewport", "content": "width=device-width, initial-scale=1"} in found.attributes(
        "meta"
    )
    assert found.attributes("html")[0]["lang"] == "en"
    (skip,) = found.attributes("a")
    assert skip["href"] == f"#{found.attributes('main')[0]['id']}"
