"""The page for people."""

import re

import pytest

from studies.published.report.page import page


@pytest.fixture(scope="module")
def html(study):
    return page(study).text


def test_the_page_says_the_verdict_first_and_needs_no_network(html):
    assert html.index("Explained: base_servo and shear_thinning") < html.index(
        "What the figures support"
    )
    assert "://" not in html


def test_every_picture_says_what_it_shows(html):
    alts = re.findall(r'<img alt="([^"]*)" [^>]*src="data:image/png;base64,', html)
    assert len(alts) == 3
    assert all("σ" in alt or "angle" in alt for alt in alts)
    # The largest residual of the stated model is 16.02, at 10 cm with 50 mm free.
    assert "up to 16 σ" in alts[0]


def test_both_materials_have_their_tables(html):
    assert html.index("Table IV, settling, 5 cm") < html.index("Gelatin")
    assert html.index("Table II, held torque, 2.5 cm") > html.index("Gelatin")
    assert html.count("<table>") == 10
