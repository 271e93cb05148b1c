"""Tissue that relaxes: closed forms of a stiff shaft in it, and Kelvin-Voigt tissue as a case of it."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.freeform.families.relaxing import TIMES_S, families
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from models.tissue import Interface

ANGLE = turns(6.0)
(LAW,) = families(covered(ANGLE, torque=ANGLE))
NONE = (0.0,) * len(TIMES_S)


def test_tissue_without_branches_is_the_nominal_one():
    assert same_readings(ANGLE, LAW.effect.apply(NOMINAL, 1.0, *NONE), NOMINAL)
    assert LAW.says in VOCABULARY


@pytest.mark.parametrize("branch", [1, 2, 3])
def test_a_turn_that_stops_is_held_by_a_torque_that_falls_by_the_relaxation_time(branch):
    """Of a stiff shaft: L k tau rate (1 - exp(-T / tau)) exp(-t / tau), after it has turned for T."""
    k, tau, rate_deg_s, turned_s = 0.003, TIMES_S[branch], 40.0, 3.0
    time_s = np.arange(0.0, 8.0, 0.02)
    angle = rate_deg_s * np.minimum(time_s, turned_s)
    stiffness = [k if i == branch else 0.0 for i in range(len(TIMES_S))]
    rig = LAW.effect.apply(RigParameters(stiffness_scale=1e4), 1.0, *stiffness)
    ready = prepared(trial(angle, step=0.02))
    (seen,) = predict(RIG, ready, [rig])
    after_s = ready.time_s - turned_s
    held = after_s > 0.5
    start = ready.inserted_mm[0] * k * tau * np.radians(rate_deg_s) * (1 - np.exp(-turned_s / tau))
    expected = start * np.exp(-after_s[held] / tau)
    # The motion of the base is smoothed at its corner, over some hundredths of a second.
    np.testing.assert_allclose(seen.base_torque_n_mm[held], expected, atol=0.01 * start)


def test_yielding_tissue_behind_viscous_friction_is_one_branch():
    """A damper b in series with a spring k beside a damper c has the modulus of a damper b c / (b + c)
    beside one branch of k b^2 / (b + c)^2, which relaxes in (b + c) / k."""
    b, tau = RIG.tissue.damping_n_mm_s_per_mm, TIMES_S[2]
    c = 0.5 * b
    k = (b + c) / tau
    series = RigParameters(tissue_stiffness_n_mm_per_rad_per_mm=k, tissue_time_constant_s=c / k)
    branches = [k * (b / (b + c)) ** 2 if time_s == tau else 0.0 for time_s in TIMES_S]
    assert same_readings(ANGLE, series, LAW.effect.apply(NOMINAL, c / (b + c), *branches), within=2e-3)
    assert not same_readings(ANGLE, series, NOMINAL, within=2e-2)
    assert LAW.contains == ("tissue_viscoelasticity",)


def test_half_the_law_has_branches_of_half_the_stiffness():
    law = LAW.effect.apply(NOMINAL, 1.0, *(0.002 for _ in TIMES_S)).free
    assert isinstance(law, FreeLaw)
    half = law.times(0.5)
    for whole, part in zip(law.throughout, half.throughout, strict=True):
        assert isinstance(part, Interface)
        assert part.stiffness_n_mm_per_rad_per_mm == pytest.approx(
            0.5 * whole.stiffness_n_mm_per_rad_per_mm
        )
        assert part.viscous_n_mm_s_per_mm == pytest.approx(0.5 * whole.viscous_n_mm_s_per_mm)
