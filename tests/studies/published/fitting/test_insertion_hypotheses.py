"""Hypotheses on the steered insertion."""

import math

import numpy as np
import pytest

from studies.published.experiments.insertion import InsertionRig
from studies.published.fitting.insertion_hypotheses import (
    ALL_INSERTION_HYPOTHESES,
    STATED_INSERTION,
    prebend_drag_n_mm_s,
    prebend_torque_n_mm,
)


def test_the_prebent_tip_costs_its_bending_moment_times_its_angle():
    # E = 2 G (1 + nu), I = pi d^4 / 64; a moment E I / R turns through 15 deg.
    modulus = 2 * 27.2e3 * 1.33
    moment = modulus * math.pi * 0.59**4 / 64 / 61.0
    assert prebend_torque_n_mm() == pytest.approx(moment * math.radians(15.0), rel=1e-9)
    assert prebend_torque_n_mm() == pytest.approx(1.85, abs=0.01)


def test_the_drag_of_the_prebent_tip_is_the_sum_over_its_length():
    x = (np.arange(1000) + 0.5) * 0.012
    across = 2 * 0.0172535 / 0.295**2  # per mm and mm/s
    drag = (across * (x * math.sin(math.radians(15.0))) ** 2 * 0.012).sum()
    assert prebend_drag_n_mm_s() == pytest.approx(drag, rel=1e-5)


def test_every_hypothesis_is_the_stated_rig_but_for_one_thing():
    for hypothesis in ALL_INSERTION_HYPOTHESES:
        p = hypothesis.parameter
        assert bool(hypothesis.basis) != bool(p), hypothesis.name
        rig = hypothesis.apply(p.high if p else math.nan)
        if hypothesis is STATED_INSERTION or hypothesis.name == "slower base, alone":
            continue  # a slower base is the stated one at its highest rate
        assert rig != InsertionRig(), hypothesis.name


def test_names_with_their_basis_are_different():
    names = [(h.name, h.basis) for h in ALL_INSERTION_HYPOTHESES]
    assert len(set(names)) == len(names)


def test_a_slower_base_takes_longer_for_its_turn():
    slower = next(h for h in ALL_INSERTION_HYPOTHESES if h.name == "slower base, alone")
    assert slower.apply(150.0).turn.time_s == pytest.approx(0.6)
    assert slower.apply(300.0) == InsertionRig()
