"""Bad and doubtful logs: each is one change to a good log, and one clear message.

The good log is analytic: the tip follows the base with a first-order lag, the torque
is a spring between the two. White noise as claimed is added, so that it scatters.
"""

import re
import time
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
import yaml
from diagnosis.contradictions import misfit
from diagnosis.faults import quantum, scatter
from diagnosis.rig_log import UnusableLog, read_rig_log
from diagnosis.spelling import look_alike
from diagnosis.trial import COLUMNS
from diagnosis.trial_file import MOST_ROWS

from scripts.main import main

TIP, TORQUE, BASE = 0.4, 0.015, 0.02
SPRING_N_MM_PER_DEG = 0.04  # about kappa of the nominal needle over 140 mm
STEP_S = 0.01


def behind(base, lag_s):
    """What a first-order lag makes of samples."""
    tip = np.zeros(base.size)
    for i in range(1, base.size):
        tip[i] = tip[i - 1] + STEP_S / lag_s * (base[i] - tip[i - 1])
    return tip


def table(*, corners_s, angles_deg, speed_mm_s, lag_s, seed):
    """A trial of 100 rows a second."""
    rng = np.random.default_rng(seed)
    at = np.arange(0, corners_s[-1], STEP_S)
    base = np.interp(at, corners_s, angles_deg)
    tip = behind(base, lag_s)
    exact = {
        "time_s": at,
        "base_angle_deg": base + rng.normal(0, BASE, at.size),
        "base_torque_n_mm": SPRING_N_MM_PER_DEG * (base - tip) + rng.normal(0, TORQUE, at.size),
        "tip_angle_deg": tip + rng.normal(0, TIP, at.size),
        "inserted_mm": np.full(at.size, 100.0),
        "free_mm": 70.0 - speed_mm_s * at,
        "speed_mm_s": np.full(at.size, speed_mm_s),
    }
    return pd.DataFrame(exact).round(4)


CORNERS = {"corners_s": [0, 1, 2, 6, 7, 12], "angles_deg": [0, 0, 90, 90, -30, -30]}
TURNS = table(**CORNERS, speed_mm_s=0, lag_s=0.5, seed=1)
SLIDES = table(corners_s=[0, 1, 2, 8], angles_deg=[0, 0, -120, -120], speed_mm_s=-2.5, lag_s=0.8, seed=2)
RIG = {
    "format": "rig-log/1",
    "needle": {"diameter_mm": 0.59, "shear_modulus_gpa": 27.2, "density_g_cm3": 6.45},
    "tissue": {"damping_n_mm_s_per_mm": 0.017},
    "sensors": {
        "tip_angle_noise_deg": TIP,
        "base_torque_noise_n_mm": TORQUE,
        "base_angle_noise_deg": BASE,
    },
    "trials": [{"file": "turns.csv"}, {"file": "slides.csv"}],
}


@pytest.fixture
def log(tmp_path):
    folder = tmp_path / "log"
    folder.mkdir()
    TURNS.to_csv(folder / "turns.csv", index=False)
    SLIDES.to_csv(folder / "slides.csv", index=False)
    (folder / "rig.yaml").write_text(yaml.safe_dump(RIG))
    return folder


def change_trial(folder, change, name="turns.csv"):
    path = folder / name
    change(pd.read_csv(path)).to_csv(path, index=False)


def change_text(folder, change, name="turns.csv"):
    path = folder / name
    path.write_text(change(path.read_text()))


def change_rig(folder, change):
    content = yaml.safe_load((folder / "rig.yaml").read_text())
    change(content)
    (folder / "rig.yaml").write_text(yaml.safe_dump(content))


def refusal(folder):
    with pytest.raises(UnusableLog) as caught:
        read_rig_log(folder)
    return str(caught.value)


def at(column, **rows):
    """Set some rows of a column: `at("tip_angle_deg", r5=3.0)`."""

    def change(t):
        t[column] = t[column].astype(object)
        for row, value in rows.items():
            t.loc[int(row[1:]), column] = value
        return t

    return change


def scaled(column, factor):
    return lambda t: t.assign(**{column: factor * t[column]})


def swapped(one, other):
    return lambda t: t.rename(columns={one: other, other: one})


def renamed(old, new):
    return lambda t: t.rename(columns={old: new})


def test_a_good_log_is_read_without_a_warning(log):
    found = read_rig_log(log)
    assert found.warnings == ()
    assert [trial.name for trial in found.trials] == ["turns.csv", "slides.csv"]
    for trial, wrote in zip(found.trials, (TURNS, SLIDES), strict=True):
        for column in TURNS:
            np.testing.assert_array_equal(trial[column], wrote[column])


def test_nothing_of_the_users_is_changed(log):
    change_trial(log, lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"].clip(upper=40)))
    before = {path: path.read_bytes() for path in log.iterdir()}
    assert read_rig_log(log).warnings
    assert {path: path.read_bytes() for path in log.iterdir()} == before


def test_the_command_refuses_with_2_and_one_message(log, capsys):
    change_trial(log, lambda t: t.drop(columns="free_mm"))
    assert main(["diagnose", str(log)]) == 2
    assert "free_mm" in capsys.readouterr().err


NAMES = [
    ("tip_angle_deg", "tip_angle_rad", "multiply it by 57.2958 and rename it"),
    ("tip_angle_deg", "Tip Angle [deg]", "rename it"),
    ("tip_angle_deg", "tipAngle", "bring it to the unit"),
    ("tip_angle_deg", "angle_tip_deg", "rename it"),
    ("base_angle_deg", "Base Angle (rad)", "57.2958"),
    ("base_torque_n_mm", "base_torque_mNm", "rename it"),
    ("base_torque_n_mm", "base_torque_Nm", "multiply it by 1000"),
    ("base_torque_n_mm", "torque", "bring it to the unit"),
    ("time_s", "time_ms", "multiply it by 0.001"),
    ("time_s", "t", "expected time_s"),
    ("free_mm", "free_cm", "multiply it by 10"),
    ("inserted_mm", "insertion_mm", "rename it"),
    ("speed_mm_s", "speed_m_s", "multiply it by 1000"),
    ("speed_mm_s", "speed [mm/s]", "rename it"),
]


@pytest.mark.parametrize(("wanted", "found", "mend"), NAMES)
def test_a_column_of_another_name_or_unit_is_said_and_not_guessed(log, wanted, found, mend):
    change_trial(log, renamed(wanted, found))
    said = refusal(log)
    assert "turns.csv, line 1" in said
    assert f"{wanted!r} is missing" in said
    assert found in said
    assert mend in said


@pytest.mark.parametrize("name", ["temperature_c", "tip_x_mm", "motor_current_a", "base_speed_deg_s"])
def test_a_column_of_something_else_is_no_look_alike(log, name):
    change_trial(log, lambda t: t.drop(columns="tip_angle_deg").assign(**{name: 1.0}))
    assert not read_rig_log(log).trials[0].has("tip_angle_deg")


def test_a_look_alike_belongs_to_the_name_that_it_is_most_like():
    found = look_alike(["tip_torque_nm"], "tip_torque_n_mm", COLUMNS)
    assert found is not None
    assert found.factor == 1000
    assert look_alike(["tip_torque_nm"], "base_torque_n_mm", COLUMNS) is None


CELLS = [
    (at("inserted_mm", r5=None), r"line 7, column 'inserted_mm'.*an empty cell"),
    (at("tip_angle_deg", r8="off"), r"line 10, column 'tip_angle_deg'.*'off'.*empty"),
    (at("base_torque_n_mm", r3=np.inf), r"line 5, column 'base_torque_n_mm'.*-10000 to 10000.*'inf'"),
    (at("base_angle_deg", r3="0,5"), r"line 5, column 'base_angle_deg'.*'0,5'"),
    (at("free_mm", r2=-5), r"line 4, column 'free_mm'.*0 to 1000.*'-5.0'"),
    (at("inserted_mm", r2=5000), r"line 4, column 'inserted_mm'.*0 to 1000.*unit"),
    (at("tip_angle_deg", r2=1e6), r"line 4, column 'tip_angle_deg'.*100000.*unit"),
    (at("speed_mm_s", r2=-1e4), r"line 4, column 'speed_mm_s'"),
    (at("time_s", r2=0.01), r"line 4, column 'time_s'.*after 0.01.*got 0.01; remove one"),
    (at("time_s", r2=0.005), r"line 4, column 'time_s'.*got 0.005; sort"),
    (lambda t: t.assign(time_s=1000 * t["time_s"]), r"column 'time_s'.*milliseconds, divide by 1000"),
    (lambda t: t.head(3), r"at least 20 rows.*got 3"),
    (lambda t: t.head(0), r"at least 20 rows.*got 0"),
    (lambda t: t.assign(inserted_mm=True), r"line 2, column 'inserted_mm'.*'True'"),
]


@pytest.mark.parametrize(("change", "said"), CELLS)
def test_a_wrong_cell_is_named_by_line_and_column(log, change, said):
    change_trial(log, change)
    with pytest.raises(UnusableLog, match=rf"(?s)turns\.csv.*{said}"):
        read_rig_log(log)


TEXTS = [
    (lambda s: "", r"line 1.*empty"),
    (lambda s: s.replace(",", ";"), r"line 1.*commas between.*;"),
    (lambda s: s.replace(",", ";").replace(".", ","), r"line 1.*decimal points"),
    (lambda s: s.replace("\n0.0,", "\n0,0,", 1), r"line 2: expected 7 cells.*got 8.*decimal point"),
    (lambda s: s.replace("\n0.05,", "\n0,05,", 1), r"line 7.*decimal point"),
    (lambda s: s.replace("\n0.05,", "\n\n0.05,", 1), r"line 7, column 'time_s'.*an empty cell"),
    (lambda s: s.replace("tip_angle_deg", "free_mm", 1), r"line 1.*'free_mm' is there twice"),
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
    assert "got a folder" in refusal(log)


FIELDS = [
    (lambda c: c.update(format="rig-log/2"), "expected 'rig-log/1', found 'rig-log/2'"),
    (
        lambda c: c["needle"].update(diameter_mm=5000),
        r"needle.diameter_mm: .*0.05 to 10, got 5000",
    ),
    (
        lambda c: c["needle"].update(shear_modulus_gpa=27200),
        r"shear_modulus_gpa: .*1000, got 27200",
    ),
    (lambda c: c["tissue"].update(damping_n_mm_s_per_mm=17.0), r"damping_n_mm_s_per_mm.*got 17"),
    (lambda c: c["sensors"].update(tip_angle_noise_deg=-1), r"tip_angle_noise_deg.*-1"),
    (lambda c: c["sensors"].update(tip_angle_noise_deg=720), r"tip_angle_noise_deg: .*0 to 90"),
    (lambda c: c["needle"].update(diameter_mm="thin"), r"diameter_mm.*'thin'"),
    (lambda c: c["needle"].update(diameter_mm=float("nan")), r"diameter_mm.*nan"),
    (lambda c: c["needle"].update(diameter_m=c["needle"].pop("diameter_mm")), r"'diameter_m'.*by 1000"),
    (
        lambda c: c["needle"].update(shear_modulus_mpa=c["needle"].pop("shear_modulus_gpa")),
        r"'shear_modulus_gpa' is missing; 'shear_modulus_mpa'.*by 0.001 and rename",
    ),
    (
        lambda c: c["sensors"].update(tip_angle_noise_rad=c["sensors"].pop("tip_angle_noise_deg")),
        r"sensors: field 'tip_angle_noise_deg'.*57.2958",
    ),
    (lambda c: c["tissue"].update(damping=c["tissue"].pop("damping_n_mm_s_per_mm")), r"'damping' looks"),
    (lambda c: c["needle"].update(colour="red"), r"needle.colour"),
    (lambda c: c.update(trials=["turns.csv"]), r"trials"),
    (lambda c: c["trials"].append({"file": "turns.csv"}), r"trials.2.file: 'turns.csv' is named twice"),
    (lambda c: c["trials"].append({"file": "../turns.csv"}), r"trials.2.file.*in the folder"),
    (lambda c: c["trials"].append({"file": "/etc/hosts"}), r"trials.2.file.*in the folder"),
    (
        lambda c: c["trials"].append({"file": "C:\\turns.csv"}),
        r"trials.2.file.*in the folder",
    ),
]


@pytest.mark.parametrize(("change", "said"), FIELDS)
def test_a_wrong_field_of_rig_yaml_is_named(log, change, said):
    change_rig(log, change)
    with pytest.raises(UnusableLog, match=rf"(?s)rig\.yaml.*{said}"):
        read_rig_log(log)


YAMLS = [
    ("", "expected a mapping"),
    ("a: 1\nneedle: {x: 1}\na: 2\n", "line 3: 'a' is there twice"),
    ("needle: &n {diameter_mm: 1}\n", "line 1.*anchor or alias 'n'"),
    ("a: " + "[" * 500 + "]" * 500, "at most 10 levels"),
    ("a: !!python/name:os.system\n", "readable YAML"),
    ("x" * 300_000, "at most 200000 bytes"),
]


@pytest.mark.parametrize(("text", "said"), YAMLS)
def test_yaml_that_is_more_than_plain_values_is_refused(log, text, said):
    (log / "rig.yaml").write_text(text)
    with pytest.raises(UnusableLog, match=rf"(?s)rig\.yaml.*{said}"):
        read_rig_log(log)


def test_a_yaml_bomb_is_refused_at_once(log):
    """Nine levels of nine aliases would be 9^9 values."""
    names = "abcdefghij"
    lines = [f"{two}: &{two} [{', '.join(['*' + one] * 9)}]" for one, two in pairwise(names)]
    (log / "rig.yaml").write_text("\n".join(["a: &a [x, x, x, x, x, x, x, x, x]", *lines]))
    start = time.perf_counter()
    assert "alias" in refusal(log)
    assert time.perf_counter() - start < 1.0


def test_too_many_rows_are_refused_before_they_are_read(log):
    """Three million rows, 90 MB: a count of lines up to the first too many."""
    rows = b"0.01,0.01,0.01,0.01,100,50,0\n" * (MOST_ROWS // 10)
    with (log / "slides.csv").open("wb") as file:
        file.write(",".join(TURNS).encode() + b"\n")
        file.writelines([rows] * 15)
    start = time.perf_counter()
    said = refusal(log)
    assert time.perf_counter() - start < 2.0
    assert "slides.csv" in said
    assert f"at most {MOST_ROWS} rows" in said
    assert "every 10th row" in said


def test_a_file_of_gigabytes_is_refused_by_its_size(log):
    with (log / "turns.csv").open("r+b") as file:
        file.truncate(10**10)  # sparse: takes no room
    start = time.perf_counter()
    assert "too large" in refusal(log)
    assert time.perf_counter() - start < 0.5


CONTRADICTIONS = [
    (
        scaled("tip_angle_deg", -1),
        r"tip_angle_deg turns the opposite way.*change the sign",
    ),
    (scaled("base_torque_n_mm", -1), r"base_torque_n_mm works against base_angle_deg.*change the sign"),
    (swapped("base_angle_deg", "tip_angle_deg"), r"base_angle_deg and tip_angle_deg seem to be swapped"),
    (swapped("base_torque_n_mm", "tip_angle_deg"), r"base_torque_n_mm and tip_angle_deg seem"),
    (
        swapped("base_torque_n_mm", "base_angle_deg"),
        r"base_angle_deg and base_torque_n_mm seem",
    ),
]


@pytest.mark.parametrize(("change", "said"), CONTRADICTIONS)
def test_wrong_signs_and_swapped_columns_are_refused(log, change, said):
    change_trial(log, change)
    with pytest.raises(UnusableLog, match=rf"(?s)turns\.csv: {said}"):
        read_rig_log(log)


def test_swapped_angles_of_equal_noise_are_found_by_who_moves_first(log):
    """The claims tell nothing apart here: the tip leads, and torque falls as it runs ahead."""
    change_rig(log, lambda c: c["sensors"].update(base_angle_noise_deg=TIP))
    quick = table(corners_s=[0, 1, 1.3, 5], angles_deg=[0, 0, 90, 90], speed_mm_s=0, lag_s=1.0, seed=7)
    change_trial(log, lambda t: swapped("base_angle_deg", "tip_angle_deg")(quick))
    assert "the tip moves first" in refusal(log)


def test_swapped_lengths_are_refused(log):
    change_trial(log, swapped("inserted_mm", "free_mm"), "slides.csv")
    said = refusal(log)
    assert "slides.csv: inserted_mm" in said
    assert "swapped" in said


def test_a_log_without_any_sensor_is_refused(log):
    for name in ("turns.csv", "slides.csv"):
        change_trial(log, lambda t: t.drop(columns=["tip_angle_deg", "base_torque_n_mm"]), name)
    assert "base_torque_n_mm or tip_angle_deg" in refusal(log)


def late(values, rows):
    return np.concatenate((values[:rows], values[:-rows]))


def lagging(base, lag_s):
    return table(corners_s=base[0], angles_deg=base[1], speed_mm_s=0, lag_s=lag_s, seed=3)


WAVES = np.linspace(0, 12, 481)  # 2 Hz
LEGITIMATE = {
    "small angles": lagging(([0, 1, 2, 8], [0, 0, 2, 2]), 0.5),
    "only holding": lagging(([0, 8], [0, 0]), 0.5),
    "a tip that hardly moves": lagging(([0, 1, 2, 8], [0, 0, 90, 90]), 200.0),
    "no rest at the start": lagging(([0, 1, 8], [0, 90, 90]), 0.5),
    "half a gain": TURNS.assign(tip_angle_deg=(TURNS["tip_angle_deg"] / 2).round(4)),
    "a delay": TURNS.assign(tip_angle_deg=late(TURNS["tip_angle_deg"], 30)),
    "half a turn behind": lagging((WAVES, 60 * np.sin(4 * np.pi * WAVES)), 0.3).assign(
        tip_angle_deg=lambda t: late(t["tip_angle_deg"], 12)
    ),
    "stick and slip": TURNS.assign(
        tip_angle_deg=20 * (behind(np.interp(TURNS["time_s"], *CORNERS.values()), 0.5) / 20).round()
        + np.random.default_rng(4).normal(0, TIP, len(TURNS)).round(4)
    ),
    "sampled anyhow": TURNS.sample(frac=0.4, random_state=5).sort_values("time_s"),
    "one row in ten": TURNS.iloc[::10],
    "steps of half a degree": TURNS.assign(tip_angle_deg=(TURNS["tip_angle_deg"] * 2).round() / 2),
    "a slow sensor that is held": TURNS.assign(
        tip_angle_deg=TURNS["tip_angle_deg"].iloc[np.arange(1200) // 30 * 30].to_numpy()
    ),
    "a smooth sensor": TURNS.assign(
        tip_angle_deg=TURNS["tip_angle_deg"].rolling(40, min_periods=1).mean().round(1)
    ),
    "empty cells": TURNS.assign(tip_angle_deg=TURNS["tip_angle_deg"].where(TURNS.index % 3 == 0)),
    "seconds of the day": TURNS.assign(time_s=1.7e9 + TURNS["time_s"]),
    "a pulse of the base": TURNS.assign(
        base_angle_deg=TURNS["base_angle_deg"] + 30 * (TURNS.index == 50),
        base_torque_n_mm=TURNS["base_torque_n_mm"] + 1.2 * (TURNS.index == 50),
    ),
}


@pytest.mark.parametrize("what", LEGITIMATE)
def test_what_a_rig_may_well_do_raises_no_alarm(log, what):
    """Negative controls of every check."""
    LEGITIMATE[what].to_csv(log / "turns.csv", index=False)
    assert read_rig_log(log).warnings == ()


def frozen(column, first=300, count=150):
    def change(t):
        t.loc[first : first + count - 1, column] = t.loc[first, column]
        return t

    return change


DOUBTS = [
    (
        frozen("tip_angle_deg"),
        r"tip_angle_deg .*frozen.* 150 of 1200 samples, lines 302-451; .*not used",
    ),
    (frozen("base_torque_n_mm"), r"base_torque_n_mm .*frozen.*lines 302-451; .*not used"),
    (frozen("base_angle_deg"), r"base_angle_deg .*frozen.*lines 302-451; used as it is"),
    (lambda t: t.assign(tip_angle_deg=1.5), r"tip_angle_deg .*frozen.*1200 of 1200"),
    (
        lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"].clip(upper=60)),
        r"tip_angle_deg .*saturated.*not used",
    ),
    (
        lambda t: t.assign(base_torque_n_mm=t["base_torque_n_mm"].clip(-0.5, 1)),
        r"base_torque_n_mm .*saturated",
    ),
    (
        at("tip_angle_deg", r200=150.0, r201=149.0, r500=-99.0),
        r"tip_angle_deg .*spikes.* 3 of .*lines 202-203, 502;",
    ),
    (at("base_angle_deg", r500=360.0), r"base_angle_deg .*spikes.*line 502; used as it is"),
    (
        lambda t: t.drop(index=range(150, 200)),
        r"time_s jumps by up to 0.51 s before line 152; the base is taken to have moved smoothly",
    ),
    (
        lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"] + 4),
        r"tip_angle_deg starts away.*by [34].*offset of the sensor",
    ),
    (
        lambda t: t.assign(base_torque_n_mm=t["base_torque_n_mm"] + 0.15),
        r"base_torque_n_mm starts away from 0.*0.1",
    ),
    (lambda t: t.iloc[150:], r"tip_angle_deg starts away from base_angle_deg"),
    (lambda t: t.drop(columns="tip_angle_deg"), r"no reading of tip_angle_deg"),
    (lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"] / 57.3), r"tip_angle_deg turns 0.0.*radians"),
    (
        lambda t: t.assign(base_angle_deg=t["base_angle_deg"] / 57.3),
        r"tip_angle_deg turns [45].* times.*radians",
    ),
    (scaled("base_torque_n_mm", 100), r"base_torque_n_mm is up to .* times what twists.*units"),
    (lambda t: t.assign(speed_mm_s=2.0), r"free_mm and speed_mm_s disagree.*24 mm"),
]


@pytest.mark.parametrize(("change", "said"), DOUBTS)
def test_doubtful_data_is_used_with_a_warning(log, change, said):
    change_trial(log, change)
    found = read_rig_log(log)
    assert len(found.trials) == 2
    assert all("turns.csv" in warning for warning in found.warnings)
    assert any(re.search(said, warning) for warning in found.warnings), found.warnings


def test_a_speed_of_the_wrong_sign_is_said(log):
    change_trial(log, scaled("speed_mm_s", -1), "slides.csv")
    (warning,) = read_rig_log(log).warnings
    assert "slides.csv: free_mm and speed_mm_s disagree" in warning
    assert "speed_mm_s seems to have the wrong sign" in warning


@pytest.mark.parametrize(("column", "field"), [("tip_angle_deg", "tip_angle_noise_deg")])
def test_claims_that_a_sensor_cannot_keep_are_said(log, column, field):
    for name in ("turns.csv", "slides.csv"):
        change_trial(log, lambda t: t.assign(**{column: t[column].round()}), name)
    change_rig(log, lambda c: c["sensors"].update({field: 0.1}))
    assert any("smallest step is 1," in w and column in w for w in read_rig_log(log).warnings)
    change_rig(log, lambda c: c["sensors"].update({field: 0}))
    assert any("a noise of 0" in w and column in w for w in read_rig_log(log).warnings)


def test_faulty_samples_of_a_sensor_are_set_aside_and_no_others(log):
    change_trial(log, frozen("tip_angle_deg"))
    trial = read_rig_log(log).trials[0]
    empty = np.flatnonzero(np.isnan(trial["tip_angle_deg"]))
    np.testing.assert_array_equal(empty, np.arange(300, 450))
    assert not np.isnan(trial["base_torque_n_mm"]).any()


def test_saturated_samples_are_set_aside(log):
    """No reading is left within a scatter of the limit, where half of them would be cut off."""
    change_trial(log, lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"].clip(upper=60)))
    tip = read_rig_log(log).trials[0]["tip_angle_deg"]
    true = TURNS["tip_angle_deg"].to_numpy()
    assert np.isnan(tip[true > 60]).all()
    assert np.isfinite(tip[true < 50]).mean() > 0.98


def test_scatter_is_that_of_the_noise_and_quantum_that_of_the_display():
    rng = np.random.default_rng(6)
    values = np.linspace(0, 100, 5000) + rng.normal(0, 0.3, 5000)
    # 4500 second differences of correlated noise: a standard error of about 2 %.
    assert scatter(values) == pytest.approx(0.3, rel=0.06)
    stuck = values.copy()
    stuck[1000:2500] = stuck[1000]
    assert scatter(stuck) == pytest.approx(0.3, rel=0.06)
    assert quantum((values / 0.25).round() * 0.25) == pytest.approx(0.25)
    assert quantum(np.ones(10)) == 0


def test_a_lagging_copy_is_explained_by_a_gain_above_zero_only():
    base = TURNS["base_angle_deg"].to_numpy()
    tip = TURNS["tip_angle_deg"].to_numpy()
    same, opposite = misfit(base, tip, STEP_S)
    assert same < 0.02
    assert opposite > 0.6
    assert misfit(base, -tip, STEP_S) == pytest.approx((opposite, same))


def test_a_log_of_20000_rows_is_read_in_well_below_a_second(log):
    many = pd.concat([TURNS] * 17, ignore_index=True).head(20_000)
    many["time_s"] = (STEP_S * many.index).to_numpy().round(4)
    many.to_csv(log / "turns.csv", index=False)
    read_rig_log(log)  # imports and caches
    start = time.perf_counter()
    read_rig_log(log)
    assert time.perf_counter() - start < 0.8
