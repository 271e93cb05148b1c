"""A shaft that yields, against the closed form of linear kinematic hardening.

A torque T at the tip, with the base held and hardly any tissue, twists every piece alike:

    twist = T L / kappa + set,    set = (T - Y) (1 - q) / q  L / kappa    where T rose beyond Y,

and on the way back the set stays until the torque has fallen by 2 Y.
"""

import numpy as np
import pytest

from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

YIELD_N_MM, SLOPE, LENGTH_MM = 1.2, 0.3, 120.0
COMPLIANCE = LENGTH_MM / NITINOL.rigidity_n_mm2  # rad per N mm
YIELDING = NITINOL.but(yield_torque_n_mm=YIELD_N_MM, yield_stiffness_ratio=SLOPE)
ARRANGEMENTS = pytest.mark.parametrize("arrangement", list(Arrangement))


def run_of(needle, time_s, *, drive_deg=0.0, tip_n_mm=0.0, damping=1e-5, **discretisation):
    same = np.ones(time_s.size)
    setup = Setup(
        needle=needle,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=damping),
        free_mm=20.0,
        inserted_mm=LENGTH_MM - 20.0,
        discretisation=Discretisation(**({"elements": 8, "step_s": 0.01} | discretisation)),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=drive_deg * same,
        free_mm=20.0 * same,
        inserted_mm=(LENGTH_MM - 20.0) * same,
        speed_mm_s=0.0 * same,
        tip_torque_n_mm=tip_n_mm * same,
    )
    return simulate([setup], inputs)[0]


def loaded(needle, most_n_mm, last_n_mm, **discretisation):
    """The twist after a load at the tip that rose to the first torque and went to the last, deg."""
    time_s = np.arange(0, 8, 0.01)
    tip_n_mm = np.interp(time_s, [0, 3, 6, 8], [0, most_n_mm, last_n_mm, last_n_mm])
    run = run_of(needle, time_s, tip_n_mm=tip_n_mm, **discretisation)
    return -run.tip_deg[-1]


@ARRANGEMENTS
@pytest.mark.parametrize(
    ("most", "last", "kept"),
    [
        (1.0, 0.0, 0.0),  # never yields
        (2.0, 2.0, 2.0 - YIELD_N_MM),
        (2.0, 0.0, 2.0 - YIELD_N_MM),  # elastic on the way back
        (-2.0, 0.0, -2.0 + YIELD_N_MM),
        (2.0, -1.0, -1.0 + YIELD_N_MM),  # yields backwards: the back stress reaches T + Y
    ],
)
def test_a_load_at_the_tip_leaves_the_set_of_kinematic_hardening(arrangement, most, last, kept):
    """To a fifth of what the load changes by in one step, 0.01 N mm; tissue carries far less."""
    per_torque = np.degrees(COMPLIANCE)
    exact = per_torque * (last + kept * (1 - SLOPE) / SLOPE)
    assert loaded(YIELDING, most, last, arrangement=arrangement) == pytest.approx(
        exact, abs=2e-3 * per_torque
    )


def test_a_shaft_that_never_reaches_the_torque_is_elastic():
    time_s = np.arange(0, 5, 0.01)
    drive_deg = 20.0 * np.sin(2 * time_s)
    elastic, high = (
        run_of(needle, time_s, drive_deg=drive_deg, damping=0.02)
        for needle in (NITINOL, NITINOL.but(yield_torque_n_mm=100.0, yield_stiffness_ratio=SLOPE))
    )
    np.testing.assert_allclose(high.base_torque_n_mm, elastic.base_torque_n_mm, atol=1e-9)


@ARRANGEMENTS
def test_plastic_twist_becomes_heat(arrangement):
    """Work of the drive = heat + what shaft and hardening store, to second order in the step."""
    off = {}
    for step_s in (0.01, 0.005):
        time_s = np.arange(0, 6, 0.01)
        drive_deg = 60.0 * np.sin(1.2 * time_s)
        run = run_of(
            YIELDING, time_s, drive_deg=drive_deg, damping=0.02, step_s=step_s, arrangement=arrangement
        )
        work, heat, stored = run.outputs[
            -1, [memory_map.O_WORK, memory_map.O_DISSIPATED, memory_map.O_SHAFT_ENERGY]
        ]
        off[step_s] = abs(work / (heat + stored) - 1)
    assert off[0.01] < 1e-4
    assert off[0.005] < 0.5 * off[0.01]
    assert abs(run.base_torque_n_mm).max() > 1.5 * YIELD_N_MM


def test_its_motion_converges_with_the_step():
    """At the least in the first order, where the law has a corner: a quarter of the step, a third."""
    time_s = np.arange(0, 6, 0.02)
    drive_deg = 60.0 * np.sin(1.2 * time_s)
    coarse, fine, exact = (
        run_of(YIELDING, time_s, drive_deg=drive_deg, damping=0.02, step_s=step)
        for step in (0.02, 0.005, 0.00125)
    )
    off, less = (
        np.abs(
            np.interp(time_s, run.time_s, run.tip_deg) - np.interp(time_s, exact.time_s, exact.tip_deg)
        )
        for run in (coarse, fine)
    )
    assert less.max() < off.max() / 3


@pytest.mark.parametrize(("field", "bad"), [("yield_torque_n_mm", 0.0), ("yield_stiffness_ratio", 1.0)])
def test_an_impossible_shaft_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        NITINOL.but(**{field: bad})
