"""How the search went."""

from html_outline import HtmlOutline

from diagnosis.report.sections.search import search_section


def test_every_effect_that_was_tried_is_there_with_every_reason(dry):
    said = "".join(search_section(dry.found))
    fitted = [entry for entry in dry.found.record if entry.gap is not None]
    assert len(HtmlOutline(said).attributes("tr")) > len(fitted)
    assert all(name in said for entry in dry.found.record for name in entry.effects)
    assert "expected to stay far above what is at the noise floor" in said
