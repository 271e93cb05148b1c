"""Cells of text files."""

import pytest

from diagnosis.lab_files.readers.text_cells import cells, is_comment, is_date, is_empty, is_number


def test_a_line_is_cut_without_blanks_and_quotation_marks():
    assert cells(' "a b" ; 1,5;', ";") == ["a b", "1,5", ""]
    assert cells("  1   2 ", " ") == ["1", "2"]


@pytest.mark.parametrize(("cell", "decimal"), [("-1.5e-3", "."), ("1,5", ","), ("2D3", ".")])
def test_numbers_are_told_from_words(cell, decimal):
    assert is_number(cell, decimal)
    assert not is_number(f"{cell} V", decimal)


def test_dates_and_empty_cells_are_neither():
    assert is_date("2026-01-02 10:11:12.5")
    assert is_empty("NaN")
    assert not is_empty("0")


def test_a_quoted_cell_is_no_comment():
    assert is_comment(" # bench 2")
    assert is_comment("'bench 2")
    assert not is_comment('"t";"x"')
