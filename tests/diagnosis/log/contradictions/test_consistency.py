"""Columns that no passive needle can have produced together, and what a rig may well do."""

import numpy as np
import pytest
from analytic_log import (
    CORNERS,
    SLIDES,
    TIP,
    TURNS,
    behind,
    change_rig,
    change_trial,
    lagging,
    late,
    refusal,
    scaled,
    swapped,
    table,
)

from diagnosis.log.contradictions.consistency import refuse_contradictions
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import Trial, UnusableLog

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


def test_columns_that_scatter_as_each_other_by_chance_are_not_swapped(log):
    """The tip follows the base, not the torque: the claims are wrong, not the names."""

    def exchange(rig):
        claimed = rig["sensors"]
        tip, torque = claimed["tip_angle_noise_deg"], claimed["base_torque_noise_n_mm"]
        claimed.update(tip_angle_noise_deg=torque, base_torque_noise_n_mm=tip)

    change_rig(log, exchange)
    assert read_rig_log(log).trials


def test_swapped_lengths_are_refused(log):
    change_trial(log, swapped("inserted_mm", "free_mm"), "slides.csv")
    said = refusal(log)
    assert "slides.csv: inserted_mm" in said
    assert "swapped" in said


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
    "empty cells": TURNS.assign(tip_angle_deg=TURNS["tip_angle_deg"].where(TURNS.index % 3 == 0)),
    "seconds of the day": TURNS.assign(time_s=1.7e9 + TURNS["time_s"]),
    "a pulse of the base": TURNS.assign(
        base_angle_deg=TURNS["base_angle_deg"] + 30 * (TURNS.index == 50),
        base_torque_n_mm=TURNS["base_torque_n_mm"] + 1.2 * (TURNS.index == 50),
    ),
}


def test_angles_in_radians_are_not_taken_for_swapped(log):
    """Their torque is far beyond the twist, and would fit the tip's place."""
    for name, trial in (("turns.csv", TURNS), ("slides.csv", SLIDES)):
        strong = trial.assign(
            base_angle_deg=np.radians(trial["base_angle_deg"]),
            tip_angle_deg=np.radians(trial["tip_angle_deg"]),
            base_torque_n_mm=20 * trial["base_torque_n_mm"],
        )
        strong.to_csv(log / name, index=False)
    assert any("angles in rad" in warning for warning in read_rig_log(log).warnings)


def test_of_a_slow_sensor_that_is_held_it_is_said_alone_that_repeats_do_not_count(log):
    held = TURNS["tip_angle_deg"].iloc[np.arange(1200) // 30 * 30].to_numpy()
    TURNS.assign(tip_angle_deg=held).to_csv(log / "turns.csv", index=False)
    (said,) = read_rig_log(log).warnings
    assert "tip_angle_deg repeats its last reading" in said
    assert "not used" in said


@pytest.mark.parametrize("what", LEGITIMATE)
def test_what_a_rig_may_well_do_raises_no_alarm(log, what):
    """Negative controls of every check."""
    LEGITIMATE[what].to_csv(log / "turns.csv", index=False)
    assert read_rig_log(log).warnings == ()


def test_a_tip_that_unwinds_may_turn_against_the_base(log):
    """It begins 120 deg ahead: the torque, which follows the twist, says that no sign is wrong."""
    base = 40.0 * np.linspace(0.0, 1.0, len(TURNS))
    tip = 120.0 - base
    torque = 0.01 * (base - tip)
    unwinding = TURNS.assign(base_angle_deg=base, tip_angle_deg=tip, base_torque_n_mm=torque)
    rig = read_rig_log(log).rig
    claims = (rig.sensors.by_column(), rig.rigidity_n_mm2)
    refuse_contradictions(log, Trial(name="turns.csv", table=unwinding), *claims)
    unconfirmed = unwinding.drop(columns="base_torque_n_mm")
    with pytest.raises(UnusableLog, match="opposite way"):
        refuse_contradictions(log, Trial(name="turns.csv", table=unconfirmed), *claims)


def test_a_tip_that_is_driven_may_turn_against_the_base(log):
    (rig, trial) = (read_rig_log(log).rig, read_rig_log(log).trials[0])
    backwards = trial.table.assign(tip_angle_deg=-trial.table["tip_angle_deg"])
    claims = (rig.sensors.by_column(), rig.rigidity_n_mm2)
    with pytest.raises(UnusableLog, match="opposite way"):
        refuse_contradictions(log, Trial(name="turns.csv", table=backwards), *claims)
    driven = backwards.assign(tip_torque_n_mm=0.5)
    refuse_contradictions(log, Trial(name="turns.csv", table=driven), *claims)
