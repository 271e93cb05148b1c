"""How the page looks, where that can be read off its style sheet."""

import re

import numpy as np

from diagnosis.report.html_style import STYLE


def media(query):
    """The rules below an @media query."""
    rest = STYLE.split(f"@media {query}{{")[1]
    steps = np.cumsum([{"{": 1, "}": -1}.get(character, 0) for character in rest])
    return rest[: int(np.argmax(steps < 0))]


def variables(rules):
    return dict(re.findall(r"--([a-z-]+):(#[0-9a-f]+)", rules))


def contrast(one, other):
    """Of two colours, 1 to 21 (WCAG 2)."""

    def luminance(colour):
        digits = colour[1:] if len(colour) == 7 else "".join(2 * c for c in colour[1:])
        parts = [int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))

    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_words_can_be_read_by_day_in_the_dark_and_on_paper():
    day = variables(STYLE.split("@media")[0])
    for look in (
        day,
        day | variables(media("(prefers-color-scheme:dark)")),
        day | variables(media("print")),
    ):
        for ink in ("text", "link", "muted"):
            assert contrast(look[ink], look["page"]) > 4.5
        assert contrast(look["text"], look["warn"]) > 4.5
        assert contrast(look["text"], look["soft"]) > 4.5


def test_pictures_are_dark_in_the_dark_alone():
    assert "invert(" in media("(prefers-color-scheme:dark)")
    assert "filter:none" in media("print")


def test_what_is_wide_scrolls_within_itself_and_no_picture_is_split_on_paper():
    assert ".scroll{overflow-x:auto" in STYLE
    assert ".wide img{max-width:none;width:" in media("(max-width:48rem)")
    assert "figure,tr,.warning{break-inside:avoid}" in media("print")
    assert "p:has(+figure){break-after:avoid}" in media("print")  # nor parted from what explains it


def test_paper_shows_what_is_folded():
    assert "details::details-content{content-visibility:visible" in media("print")


def test_nothing_comes_from_elsewhere():
    assert "url(" not in STYLE
    assert "@import" not in STYLE
