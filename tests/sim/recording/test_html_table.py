"""Tables for notebooks."""

import pandas as pd

from sim.recording.html_table import html_table


def test_numbers_have_four_digits_and_nothing_stands_for_nan():
    shown = html_table("title", pd.DataFrame({"x": [1.234567, float("nan")]}))
    assert "<td>1.235</td>" in shown
    assert "<td></td>" in shown


def test_text_is_escaped_wherever_it_stands():
    evil = "<script>"
    shown = html_table(evil, pd.DataFrame({evil: [evil]}, index=[evil]))
    assert evil not in shown
    assert shown.count("&lt;script&gt;") == 4
