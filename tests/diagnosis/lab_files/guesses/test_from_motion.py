"""What the motion tells of columns that are flipped, shifted or late, and of those that are not."""

from dataclasses import replace

import numpy as np
import pytest
from analytic_log import TORQUE, TURNS
from loops import torque_of, turns_and_holds

from diagnosis.lab_files.guesses.from_motion import (
    at_times,
    loops_of,
    needed_rate_hz,
    noise_of,
    scatter,
    with_offset,
    with_sign,
    with_zero,
)
from diagnosis.lab_files.guesses.guessed import GuessedColumn
from diagnosis.lab_files.mapping import ColumnSource
from diagnosis.lab_files.motion import motion_of
from diagnosis.lab_files.series import Series

TIME = TURNS["time_s"].to_numpy()
OWN = {
    name: Series(time_s=TIME, values=TURNS[name].to_numpy(), where=name, clock=("a", 0.0))
    for name in ("base_angle_deg", "base_torque_n_mm", "tip_angle_deg")
}
MOTIONS = {"a": motion_of(TIME, OWN["base_angle_deg"].values)}


def column(wanted, unit):
    source = ColumnSource(column=wanted, unit=unit, guess=True)
    return GuessedColumn(wanted=wanted, source=source, reasons={}, known=True)


BASE, TWIST = column("base_angle_deg", "deg"), column("base_torque_n_mm", "mN m")
TIP = column("tip_angle_deg", "deg")


def trials(**changes):
    return {"a": {name: replace(one, **changes.get(name, {})) for name, one in OWN.items()}}


def torque(change):
    return trials(base_torque_n_mm={"values": change(OWN["base_torque_n_mm"].values)})


@pytest.mark.parametrize("sign", [1, -1])
def test_a_flipped_torque_is_guessed_flipped_and_one_that_is_not_is_kept(sign):
    guess = with_sign(TWIST, torque(lambda m: sign * m))
    assert guess.source.sign == sign
    assert "work" in guess.reasons["sign"]


def test_an_offset_of_the_torque_does_not_change_its_sign():
    shifted = torque(lambda m: 3.0 - m)
    zeroed = with_zero(TWIST, shifted, MOTIONS)
    assert zeroed.source.zero == pytest.approx(3, abs=0.01)
    assert with_sign(zeroed, shifted).source.sign == -1


def test_the_rest_of_a_late_clock_is_that_of_the_base():
    """Late by 3 s, the first second of the base lies before all samples of the torque."""
    late = trials(base_torque_n_mm={"time_s": TIME + 3, "values": OWN["base_torque_n_mm"].values + 2})
    right = TWIST.with_guess("time_offset_s", "known", time_offset_s=-3.0)
    assert with_zero(right, late, MOTIONS).source.zero == pytest.approx(2, abs=0.01)
    assert with_zero(TWIST, late, MOTIONS).source.zero == 0
    assert noise_of(right, late, MOTIONS) == pytest.approx(TORQUE, rel=0.1)


def test_without_an_offset_the_zero_is_kept():
    assert with_zero(TWIST, trials(), MOTIONS).source.zero == 0


OTHER_CLOCK = {"clock": ("b", 0.0)}


def test_a_late_torque_of_another_clock_gets_its_offset_with_its_uncertainty():
    late = trials(base_torque_n_mm={"time_s": TIME + 0.7, **OTHER_CLOCK})
    guess = with_offset(TWIST, late)
    assert guess.source.time_offset_s == pytest.approx(-0.7, abs=0.1)
    assert "±" in guess.reasons["time_offset_s"]


@pytest.mark.parametrize(
    "change",
    [OTHER_CLOCK, {"time_s": TIME + 0.7}],
    ids=["another clock that is right", "one clock for both"],
)
def test_no_offset_is_filled_in_where_clocks_agree_or_are_one(change):
    assert with_offset(TWIST, trials(base_torque_n_mm=change)).source.time_offset_s == 0


def test_the_lag_of_the_tip_is_no_offset_but_a_tip_that_leads_is():
    def tip_late(late):
        return with_offset(TIP, trials(tip_angle_deg={"time_s": TIME + late, **OTHER_CLOCK}))

    assert tip_late(0.0).source.time_offset_s == 0
    assert tip_late(-1.5).source.time_offset_s > 1


def test_a_rate_is_needed_only_between_clocks():
    assert needed_rate_hz([BASE, TWIST, TIP], trials()) is None
    assert needed_rate_hz([BASE, TWIST, TIP], trials(tip_angle_deg=OTHER_CLOCK)) == pytest.approx(100)


def test_noise_is_that_of_the_readings_in_units_of_rig_log():
    """About 900 samples at rest: good to 1 / sqrt(1800), 2.4 %; four of these."""
    assert noise_of(TWIST, trials(), MOTIONS) == pytest.approx(TORQUE, rel=0.1)
    metres = replace(TWIST, source=TWIST.source.but(unit="N m"))
    assert noise_of(metres, trials(), MOTIONS) == pytest.approx(1000 * TORQUE, rel=0.1)
    volts = replace(TWIST, source=TWIST.source.but(unit="V"), known=False)
    assert noise_of(volts, trials(), MOTIONS) == pytest.approx(TORQUE, rel=0.1)
    assert noise_of(None, trials(), MOTIONS) is None


def test_a_coarse_encoder_has_at_least_the_noise_of_its_steps():
    coarse = trials(base_angle_deg={"values": np.round(OWN["base_angle_deg"].values)})
    assert noise_of(BASE, coarse, MOTIONS) >= 0.99 / np.sqrt(12)


def test_loops_have_the_scale_and_sign_of_the_guesses():
    time, angle = turns_and_holds()
    moment = torque_of(angle, stiffness=4, play=2, level=20)
    clock = ("a", 0.0)
    own = {
        "base_angle_deg": Series(time_s=time, values=np.radians(angle), where="", clock=clock),
        "base_torque_n_mm": Series(time_s=time, values=-moment / 1000, where="", clock=clock),
    }
    base = replace(BASE, source=BASE.source.but(unit="rad"))
    twist = replace(TWIST, source=TWIST.source.but(unit="N m", sign=-1))
    motions = {"a": motion_of(time, np.radians(angle))}
    shape = loops_of(base, twist, {"a": own}, motions)
    assert shape.stiffness.value == pytest.approx(4, rel=0.06)
    assert shape.play.value == pytest.approx(2, abs=0.3)
    assert shape.level.value == pytest.approx(20, rel=0.01)
    assert loops_of(base, twist, {"a": {"base_angle_deg": own["base_angle_deg"]}}, motions) is None


def test_columns_at_other_times_skip_what_is_empty():
    series = Series(
        time_s=np.arange(4.0), values=np.array([0, np.nan, 2, 3]), where="", clock=("a", 0.0)
    )
    np.testing.assert_allclose(at_times(series, np.array([1.0, 2.5])), [1, 2.5])
    assert scatter([np.zeros(3)]) == 0
