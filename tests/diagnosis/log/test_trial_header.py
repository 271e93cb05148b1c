"""Files that do not begin as a trial does."""

import pytest

from diagnosis.log.trial import REQUIRED, UnusableLog
from diagnosis.log.trial_header import check_header

NAMES = ",".join([*REQUIRED, "tip_angle_deg"])
ROW = ",".join(["0.0"] * 6)


def told(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "trial_01.csv"
    path.write_bytes(text.encode(encoding))
    with pytest.raises(UnusableLog) as raised:
        check_header(path)
    return str(raised.value)


def test_names_with_a_row_of_numbers_are_right(tmp_path):
    path = tmp_path / "trial_01.csv"
    path.write_text(f"{NAMES}\n{ROW}\n")
    check_header(path)


@pytest.mark.parametrize("above", ["# made by our rig", "time,base,length,free,speed,tip"])
def test_lines_above_the_names_are_to_be_deleted(tmp_path, above):
    assert "line 1: " in told(tmp_path, f"{above}\n{NAMES}\n{ROW}\n")
    assert "delete the lines above the names" in told(tmp_path, f"{above}\n{NAMES}\n{ROW}\n")


@pytest.mark.parametrize(
    ("row", "what"),
    [
        ("s,deg,mm,mm,mm/s,deg", "a row of units: delete it"),
        ("2026-03-01 10:00:00.000,0,0,0,0,0", "a row of dates; seconds are expected"),
    ],
)
def test_a_row_without_a_time_is_told_as_what_it_looks_like(tmp_path, row, what):
    said = told(tmp_path, f"{NAMES}\n{row}\n{ROW}\n")
    assert "line 2, column 'time_s'" in said
    assert what in said
    assert "needle import" in said


@pytest.mark.parametrize(
    ("text", "encoding"),
    [(NAMES.replace(",", ";"), "utf-8"), (f"{NAMES}\n{ROW}", "utf-16"), ("temps,angle_°", "latin-1")],
)
def test_files_of_other_programs_are_for_needle_import(tmp_path, text, encoding):
    path = tmp_path / "trial_01.csv"
    path.write_bytes(text.encode(encoding))
    with pytest.raises((UnusableLog, UnicodeDecodeError)) as raised:
        check_header(path)
    assert isinstance(raised.value, UnicodeDecodeError) or "needle import" in str(raised.value)


def test_an_empty_file_is_to_be_recorded_again_or_taken_out(tmp_path):
    assert "record the trial again, or take it out of rig.yaml" in told(tmp_path, "\n")
