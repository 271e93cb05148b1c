"""The modal needle as a state space: poles, gains and Hankel values."""

import control
import numpy as np
import pytest

from models.drive import DriveKind
from models.modes import InsertedNeedle
from models.needle import NITINOL
from models.statespace import full_modal_system, hankel_ratios, modal_system

BETA = 0.01725


def held(length=200.0, free=0.0, drive=DriveKind.ANGLE):
    return InsertedNeedle(
        needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=length, free_mm=free, drive=drive
    )


def test_the_state_space_has_the_poles_and_the_dc_gain_of_the_needle():
    needle = held(free=50.0)
    system = modal_system(needle, modes=6)
    assert np.sort(system.poles().real)[::-1] == pytest.approx(
        held(drive=DriveKind.TORQUE).poles_rad_s(6), abs=1e-9
    )
    # a steady torque turns base and tip at one rate, u / b, with the lag of equation (2)
    time = np.linspace(0, 40, 4001)
    base, tip, _ = control.forced_response(
        modal_system(needle, modes=200), time, np.ones_like(time)
    ).outputs
    rate = (tip[-1] - tip[-101]) / (time[-1] - time[-101])
    assert rate == pytest.approx(1 / needle.damping_n_mm_s, rel=1e-6)
    lag = (50 + 100) / NITINOL.rigidity_n_mm2
    assert base[-1] - tip[-1] == pytest.approx(lag, rel=5e-3)  # 200 modes: the tail is 1/200


def test_the_full_modal_system_has_slow_and_fast_poles():
    needle = held(drive=DriveKind.TORQUE)
    poles = np.sort(full_modal_system(needle, modes=4).poles().real)[::-1]
    assert poles[1:4] == pytest.approx(needle.poles_with_inertia_rad_s(4)[1:], rel=1e-4)
    assert poles[4:] == pytest.approx(np.full(4, -BETA / NITINOL.rotary_inertia_kg_m), rel=1e-6)


def test_the_papers_output_equation_differs_by_half_of_mode_zero():
    system = modal_system(held(), modes=4)
    assert (system.C[2] - system.C[1]).tolist() == [0.5, 0, 0, 0]


def test_hankel_ratios_fall_and_start_at_one():
    ratios = hankel_ratios(held(), modes=6)
    assert ratios[0] == 1.0
    assert np.all(np.diff(ratios) < 0)


def test_a_slow_leak_of_mode_zero_makes_its_hankel_value_the_largest():
    leaking = hankel_ratios(held(), modes=6, leak_rad_s=1e-3)
    without = hankel_ratios(held(), modes=6)
    assert leaking.size == without.size + 1
    assert leaking[1] < 1e-2 * leaking[0]  # 1 / (2 leak) against 1 / (2 |p_1|), |p_1| = 4.6 rad/s
