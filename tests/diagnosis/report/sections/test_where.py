"""Where the residual is."""

import pytest
from matplotlib.figure import Figure

from diagnosis.report.sections import where
from diagnosis.report.sections.where import where_section
from diagnosis.report.sentences.residual import largest_parts, leading

PICTURES = ("draw_breakdown", "draw_along_motion", "draw_memory")


@pytest.fixture
def undrawn(monkeypatch):
    for name in PICTURES:
        monkeypatch.setattr(where, name, lambda _: Figure())


def test_every_picture_has_a_heading_a_sentence_and_words_for_who_cannot_see_it(dry, undrawn):
    parts = where_section(dry.found)
    pictures = [i for i, part in enumerate(parts) if part.startswith("<figure")]
    assert len(pictures) == len(PICTURES)
    for i in pictures:
        assert parts[i - 2].startswith("<h")
        assert parts[i - 1].startswith("<p>")
        assert 'alt=""' not in parts[i]


def test_the_sentences_are_those_of_the_screen(dry, undrawn):
    page = "".join(where_section(dry.found))
    assert largest_parts(dry.found) in page
    assert leading(dry.found) in page
