"""A guess with its reasons."""

import pytest

from diagnosis.lab_files.guesses.guessed import GuessedColumn
from diagnosis.lab_files.mapping import ColumnSource


def test_a_further_guess_keeps_the_others():
    source = ColumnSource(column="m", unit="N m", guess=True)
    first = GuessedColumn(wanted="base_torque_n_mm", source=source, reasons={"unit": "name"}, known=True)
    second = first.with_guess("sign", "work", sign=-1)
    assert second.scale == pytest.approx(-1000)
    assert second.reasons == {"unit": "name", "sign": "work"}
    assert first.source.sign == 1
    assert second.source.guess
