"""The figure of the score: readable on white, and drawn from a table on disk."""

import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from validation.score import picture


def brightness(path):
    """Of the PNG's pixels, 0 (black) to 1 (white), (height, width)."""
    return plt.imread(path)[..., :3].mean(axis=2)


def test_the_figure_is_drawn_from_a_table_on_a_white_ground(tmp_path, long_run, monkeypatch):
    csv, png = tmp_path / "scores.csv", tmp_path / "score.png"
    long_run.to_csv(csv)
    monkeypatch.setattr(sys, "argv", ["picture", str(csv), str(png)])
    picture.main()
    light = brightness(png)
    assert (light[0] == 1.0).all()
    assert np.mean(light > 0.9) > 0.7


def luminance(rgb):
    """Relative luminance of sRGB (WCAG 2)."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in rgb]
    return np.dot([0.2126, 0.7152, 0.0722], linear)


def test_every_number_stands_out_from_its_cell(long_run):
    """WCAG 2 asks for a contrast of 4.5 of small text, 3 of large."""
    figure, axis = plt.subplots()
    picture._confusion(axis, long_run)
    image = axis.images[0]
    for text in axis.texts:
        column, row = text.get_position()
        cell = luminance(image.cmap(image.norm(image.get_array()[row, column]))[:3])
        dark, light = sorted([cell, luminance(to_rgb(text.get_color()))])
        assert (light + 0.05) / (dark + 0.05) > 4.4, text
    assert {text.get_color() for text in axis.texts} == {"black"}
    plt.close(figure)


@pytest.mark.parametrize("what", ["own", "none", "pairs"])
def test_sets_without_signatures_or_of_one_kind_are_drawn_too(long_run, tmp_path, what):
    """As those of a rig of the user's own, whose ground truth names the effect alone."""
    tables = {
        "own": long_run.assign(signature=np.nan),
        "none": long_run[long_run["kind"] == "none"],
        "pairs": long_run[long_run["kind"] == "pair"],
    }
    picture.draw(tables[what], tmp_path / "score.png")
    assert (tmp_path / "score.png").stat().st_size > 10_000
