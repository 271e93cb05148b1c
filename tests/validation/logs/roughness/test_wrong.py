"""Faults of a recording: a clock that is far off, a sign that changes in one trial."""

import numpy as np
import pytest

from validation.logs.roughness.wrong import FAULTS, flipped_sign, wrong_clock
from validation.logs.sensors import MEASURED, TIP, TORQUE


@pytest.mark.parametrize("seed", range(6))
def test_a_wrong_clock_is_off_by_3_to_10_percent(recorded, seed):
    one = wrong_clock(np.random.default_rng(seed))
    ramps = {name: lambda time_s: 1e4 * time_s for name in ("tip_deg", "torque_n_mm")}
    (columns,) = recorded(one, **ramps)
    assert 0.03 <= abs(one.numbers["error"]) <= 0.1
    for signal in MEASURED:
        rate = np.polyfit(columns["time_s"], columns[signal], 1)[0] / 1e4
        expected = 1 + one.numbers["error"] * (signal in one.numbers["signals"])
        assert rate == pytest.approx(expected, abs=1e-5)


def test_the_clock_of_either_sensor_or_of_both_is_wrong():
    drawn = [wrong_clock(np.random.default_rng(seed)).numbers["signals"] for seed in range(30)]
    assert {tuple(signals) for signals in drawn} == {(TIP,), (TORQUE,), (TIP, TORQUE)}


@pytest.mark.parametrize("seed", range(6))
def test_a_sign_is_flipped_in_the_trial_and_column_that_are_named(recorded, seed):
    one = flipped_sign(np.random.default_rng(seed))
    flipped, plain = recorded(one, trials=4), recorded(trials=4)
    for i, (rough, clean) in enumerate(zip(flipped, plain, strict=True)):
        for column in clean:
            here = one.numbers == {"column": column, "trial": f"trial_{i + 1:02d}.csv"}
            assert (rough[column] == (-clean[column] if here else clean[column])).all()


def test_faults_name_themselves():
    assert all(make(np.random.default_rng(0)).name == name for name, make in FAULTS.items())
