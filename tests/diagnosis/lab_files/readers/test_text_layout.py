"""Layouts of text files, as instruments and spreadsheets write them."""

import pytest

from diagnosis.lab_files.readers.text_layout import text_layout

ROWS = {
    "german": (["t;x", "0,0;1,5", "0,1;2,5", "0,2;3,5"], ";", ","),
    "english": (["t,x", "0.0,1.5", "0.1,2.5", "0.2,3.5"], ",", "."),
    "whole numbers": (["t,x", "0,1", "1,2", "2,3"], ",", "."),
    "tabs and commas": (["t\tx", "0,0\t1,5", "0,1\t2,5"], "\t", ","),
    "blanks": (["t x", " 0.0   1.5e-3", " 0.1   2.5e-3"], " ", "."),
    "semicolons and points": (["t; x", "0.0; 1.5", "0.1; -2.5"], ";", "."),
    "empty cells": (["t;x;y", "0.1;;2.5", "0.2;1.5;", "0.3;;2.5"], ";", "."),
}


@pytest.mark.parametrize("kind", ROWS)
def test_separator_and_decimal_sign_are_found(kind):
    lines, separator, decimal = ROWS[kind]
    layout = text_layout(lines)
    assert (layout.separator, layout.decimal) == (separator, decimal)
    assert layout.names[:2] == ("t", "x")
    assert layout.first_row == 1


@pytest.mark.parametrize(
    "above",
    [
        ["# rig 2; 5 N", "t; disp (in); force (kip)"],
        ["Operator: A. B.", "", "# t; disp (in); force (kip)"],
        ["t; disp; force", "# second calibration", "s; in; kip"],
        ["%% t; disp (in); force (kip)", "# 3 2 1"],
        ['"t"; "disp (in)"; "force (kip)"'],
    ],
)
def test_a_header_is_found_among_comments_and_units(above):
    layout = text_layout([*above, "0.0; 1.5; 2", "0.1; 2.5; 3", "0.2; 2.6; 4"])
    assert layout.named
    assert [name.split()[0] for name in layout.names] == ["t", "disp", "force"]
    assert ["in" in name for name in layout.names] == [False, True, False]
    assert layout.first_row == len(above)


def test_without_a_header_columns_are_numbered():
    layout = text_layout(["0.0 1", "0.1 2", "0.2 3"])
    assert not layout.named
    assert layout.names == ("column 1", "column 2")


def test_text_is_no_table():
    assert text_layout(["one", "two three", "and four"]) is None
    assert text_layout([]) is None
