"""Reading a trial: each bad file is one change to a good one, and one clear message."""

import time

import numpy as np
import pandas as pd
import pytest
from analytic_log import TURNS, at, change_rig, change_text, change_trial, refusal

from diagnosis.criteria.log import MOST_ROWS
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import UnusableLog
from diagnosis.log.trial_file import read_trial

CELLS = [
    (at("inserted_mm", r5=None), r"line 7, column 'inserted_mm'.*an empty cell"),
    (at("tip_angle_deg", r8="off"), r"line 10, column 'tip_angle_deg'.*'off'.*empty"),
    (at("base_torque_n_mm", r3=np.inf), r"line 5, column 'base_torque_n_mm'.*-10000 to 10000.*'inf'"),
    (at("base_angle_deg", r3="0,5"), r"line 5, column 'base_angle_deg'.*'0,5'"),
    (at("free_mm", r2=-5), r"line 4, column 'free_mm'.*0 to 5000.*'-5.0'"),
    (at("inserted_mm", r2=50000), r"line 4, column 'inserted_mm'.*0 to 5000.*unit"),
    (at("tip_angle_deg", r2=1e6), r"line 4, column 'tip_angle_deg'.*100000.*unit"),
    (at("speed_mm_s", r2=-1e4), r"line 4, column 'speed_mm_s'"),
    (at("time_s", r2=0.01), r"line 4, column 'time_s'.*after 0.01.*found 0.01; remove one"),
    (at("time_s", r2=0.005), r"line 4, column 'time_s'.*found 0.005; sort"),
    (lambda t: t.assign(time_s=1000 * t["time_s"]), r"column 'time_s'.*milliseconds, divide by 1000"),
    (lambda t: t.head(3), r"at least 20 rows.*found 3"),
    (lambda t: t.head(0), r"at least 20 rows.*found 0"),
    (lambda t: t.assign(inserted_mm=True), r"line 2, column 'inserted_mm'.*'True'"),
]

_ENDLESS_S = 20.0  # what is refused at once on any machine, however busy, and what would never end


@pytest.mark.parametrize(("change", "said"), CELLS)
def test_a_wrong_cell_is_named_by_line_and_column(log, change, said):
    change_trial(log, change)
    with pytest.raises(UnusableLog, match=rf"(?s)turns\.csv.*{said}"):
        read_rig_log(log)


TEXTS = [
    (lambda s: "", r"line 1.*empty"),
    (lambda s: s.replace(",", ";"), r"line 1.*commas between.*;"),
    (lambda s: s.replace(",", ";").replace(".", ","), r"line 1.*decimal points"),
    (lambda s: s.replace("\n0.0,", "\n0,0,", 1), r"line 2: expected 7 cells.*found 8.*decimal point"),
    (lambda s: s.replace("\n0.05,", "\n0,05,", 1), r"line 7.*decimal point"),
    (lambda s: s.replace("\n0.05,", "\n\n0.05,", 1), r"line 7, column 'time_s'.*an empty cell"),
    (lambda s: s.replace("tip_angle_deg", "free_mm", 1), r"line 1.*'free_mm' appears twice"),
    (lambda s: s[: s.rindex("70.0")], r"line 1201, column 'free_mm'.*an empty cell"),
    (lambda s: "time_s\0,b\n" + s, r"UTF-8 text.*binary"),
]


@pytest.mark.parametrize(("change", "said"), TEXTS)
def test_a_file_that_is_no_such_table_is_refused(log, change, said):
    change_text(log, change)
    with pytest.raises(UnusableLog, match=rf"(?s)turns\.csv.*{said}"):
        read_rig_log(log)


def test_spaces_in_a_header_and_blank_lines_at_the_end_do_no_harm(log):
    change_text(log, lambda s: "\ufeff" + s.replace("tip_angle_deg", " tip_angle_deg ", 1) + "\n\n")
    found = read_rig_log(log)
    assert found.warnings == ()
    np.testing.assert_array_equal(found.trials[0]["tip_angle_deg"], TURNS["tip_angle_deg"])


def test_what_is_no_text_file_is_refused(log):
    (log / "turns.csv").write_bytes(b"\x89PNG\r\n\x1a\n\xff\xfe" * 100)
    assert "UTF-8" in refusal(log)
    (log / "turns.csv").unlink()
    assert "no such file" in refusal(log)
    (log / "turns.csv").mkdir()
    assert "found a folder" in refusal(log)


def test_too_many_rows_are_refused_before_they_are_read(log):
    """Three million rows, 90 MB: a count of lines up to the first too many."""
    rows = b"0.01,0.01,0.01,0.01,100,50,0\n" * (MOST_ROWS // 10)
    with (log / "slides.csv").open("wb") as file:
        file.write(",".join(TURNS).encode() + b"\n")
        file.writelines([rows] * 15)
    start = time.process_time()
    said = refusal(log)
    assert time.process_time() - start < _ENDLESS_S
    assert "slides.csv" in said
    assert f"at most {MOST_ROWS} rows" in said
    assert "every 10th row" in said


def test_a_file_of_gigabytes_is_refused_by_its_size(log):
    with (log / "turns.csv").open("r+b") as file:
        file.truncate(10**10)  # sparse: takes no room
    start = time.process_time()
    assert "too large" in refusal(log)
    assert time.process_time() - start < _ENDLESS_S


COLUMNS = [
    (lambda t: t.drop(columns="free_mm"), "free_mm"),
    (lambda t: t.rename(columns={"base_angle_deg": "base_angle_rad"}), "base_angle_deg"),
    (lambda t: t.assign(inserted_mm=np.nan), r"line 2.*inserted_mm"),
    (lambda t: t.assign(time_s=0.0), "time_s"),
    (lambda t: t.iloc[::-1], "time_s"),
    (lambda t: t.head(1), "at least 20 rows"),
    (lambda t: t.assign(free_mm=-5.0), "free_mm"),
]


@pytest.mark.parametrize(("change", "said"), COLUMNS)
def test_what_is_wrong_with_a_trial_is_named(log, change, said):
    change_trial(log, change)
    with pytest.raises(UnusableLog, match=f"(?s)turns.csv.*{said}"):
        read_trial(log / "turns.csv")


@pytest.mark.parametrize("pause_s", [1e6, 1e10])
def test_a_pause_that_cannot_be_replayed_is_refused_with_what_it_would_cost(log, pause_s):
    def paused(t):
        t.loc[300:, "time_s"] += pause_s
        return t

    change_trial(log, paused)
    said = refusal(log)
    assert "line 302, column 'time_s'" in said
    assert "make two trials of it" in said
    assert f"{pause_s / 0.01:.3g} steps" in said


def test_a_pause_of_minutes_is_read(log):
    change_trial(log, lambda t: t.assign(time_s=t["time_s"] + 300.0 * (t.index >= 300)))
    assert np.diff(read_rig_log(log).trials[0]["time_s"]).max() == pytest.approx(300.01)


@pytest.mark.parametrize("ending", ["zip", "xz", "tar", "zst", "gz", "bz2"])
def test_a_text_file_is_read_as_text_whatever_its_name_ends_in(log, ending):
    expected = read_rig_log(log).trials[0].table
    (log / "turns.csv").rename(log / f"turns.{ending}")
    change_rig(log, lambda c: c["trials"][0].update(file=f"turns.{ending}"))
    pd.testing.assert_frame_equal(read_rig_log(log).trials[0].table, expected)
