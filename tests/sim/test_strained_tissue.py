"""Tissue that hardens or softens with its twist, or for good, against closed forms and its energy."""

import numpy as np
import pytest
from stiff_shaft import ARRANGEMENTS, LENGTH_MM, STEP_S, factor, turned

from models.contact import ContactCurve, contact_places
from models.tissue import Tissue
from sim.kernel import memory_map

HARDENS_DEG = 12.0


def hardening(steepness):
    """Stiffness over the twist, times (1 + (twist / HARDENS_DEG)^2)^steepness."""
    at = contact_places(3.0, 60.0)
    factors = (1 + (at / HARDENS_DEG) ** 2) ** steepness
    return ContactCurve(over="twist", scale=3.0, last=60.0, factors=tuple(factors))


@ARRANGEMENTS
@pytest.mark.parametrize("sign", [1, -1])
def test_tissue_that_hardens_takes_the_torque_of_its_twist(arrangement, sign):
    """Friction so high that nothing slips: at rest the tissue is twisted by the angle of the base."""
    curve_of, stiffness = hardening(1.0), 0.01
    time_s = np.arange(0, 12, STEP_S)
    drive_deg = sign * np.minimum(6.0 * time_s, 30.0)
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=1e6,
        stiffness_n_mm_per_rad_per_mm=stiffness,
        time_constant_s=0.2,
        contact=curve_of,
    )
    run = turned(tissue, time_s, drive_deg, arrangement=arrangement)
    exact = sign * stiffness * factor(curve_of, 30.0) * np.radians(30.0) * LENGTH_MM
    assert run.base_torque_n_mm[-1] == pytest.approx(exact, rel=1e-4)


def softening():
    """Stiffness over the largest twist so far: a third of itself from 30 deg on."""
    at = contact_places(3.0, 60.0)
    factors = 1 / 3 + (2 / 3) * np.clip(1 - at / 30.0, 0.0, 1.0)
    return ContactCurve(over="strained", scale=3.0, last=60.0, factors=tuple(factors))


@ARRANGEMENTS
@pytest.mark.parametrize("sign", [1, -1])
def test_tissue_that_was_strained_is_softer_for_good(arrangement, sign):
    """Friction so high that nothing slips: held at 10 deg before and after a twist of 40 deg."""
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=1e6,
        stiffness_n_mm_per_rad_per_mm=0.01,
        time_constant_s=0.2,
        contact=softening(),
    )
    time_s = np.arange(0, 24, STEP_S)
    drive_deg = sign * np.interp(time_s, [0, 2, 6, 8, 12, 18, 24], [0, 10, 10, 40, 40, 10, 10])
    run = turned(tissue, time_s, drive_deg, arrangement=arrangement)
    held = {at: run.base_torque_n_mm[np.searchsorted(run.time_s, at)] for at in (5.9, 11.9, 23.9)}
    twist = {5.9: (10.0, 10.0), 11.9: (40.0, 40.0), 23.9: (10.0, 40.0)}
    for at, (now_deg, most_deg) in twist.items():
        exact = sign * 0.01 * factor(softening(), most_deg) * np.radians(now_deg) * LENGTH_MM
        assert held[at] == pytest.approx(exact, rel=1e-4)


def test_what_softening_tissue_loses_becomes_heat():
    """Work = heat + what is stored: tissue that softens while it is twisted gives less back."""
    time_s = np.arange(0, 5, STEP_S)
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=0.5,
        stiffness_n_mm_per_rad_per_mm=0.02,
        time_constant_s=0.05,
        contact=softening(),
    )
    run = turned(tissue, time_s, 40.0 * np.sin(0.8 * time_s))
    work, heat = run.outputs[-1, [memory_map.O_WORK, memory_map.O_DISSIPATED]]
    stored = run.outputs[-1, [memory_map.O_SHAFT_ENERGY, memory_map.O_TISSUE_ENERGY]].sum()
    # The factor is that at the start of a stage: late by 0.3 deg of 40.
    assert work == pytest.approx(heat + stored, rel=5e-3)


@pytest.mark.parametrize("steepness", [1.0, -0.4])
def test_what_hardening_tissue_stores_it_gives_back(steepness):
    """Work = heat + energy of tissue and shaft, while it is twisted, whether it hardens or softens."""
    time_s = np.arange(0, 5, STEP_S)
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=0.5,
        stiffness_n_mm_per_rad_per_mm=0.02,
        time_constant_s=0.05,
        contact=hardening(steepness),
    )
    run = turned(tissue, time_s, 40.0 * np.sin(0.8 * time_s))
    at = np.argmax(run.outputs[:, memory_map.O_TISSUE_ENERGY])
    work, heat = run.outputs[at, [memory_map.O_WORK, memory_map.O_DISSIPATED]]
    stored = run.outputs[at, [memory_map.O_SHAFT_ENERGY, memory_map.O_TISSUE_ENERGY]]
    assert stored[1] > 0.2 * work
    assert work == pytest.approx(heat + stored.sum(), rel=1e-3)
