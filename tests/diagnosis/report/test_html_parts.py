"""Parts of a page: plain text stays plain text."""

import matplotlib.pyplot as plt
import pytest

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
        html.table((TEXT,), [(TEXT,)]),
        html.document(TEXT, []),
    ],
)
def test_text_is_escaped(part):
    assert SAFE in part
    assert "<script>" not in part


def test_a_heading_has_its_level():
    assert html.heading("Gap", level=1) == "<h1>Gap</h1>"


def test_a_table_has_a_head_and_its_rows():
    found = html.table(("a", "b"), [("1", "2"), ("3", "4")])
    assert found.count("<tr>") == 3
    assert found.count("<th>") == 2


def test_a_picture_is_inside_the_page_and_closed():
    figure, _ = plt.subplots()
    found = html.picture(figure, alt="what it shows")
    assert found.startswith('<img alt="what it shows" src="data:image/png;base64,')
    assert not plt.fignum_exists(figure.number)
