"""The numeric fields carry the constants of needle and chuck in SI units."""

import math

import numpy as np
import pytest

from models.drive import Drive
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.numeric_fields import header, numeric_fields, springs_n_m_per_rad
from sim.needles.setup import Setup

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.01725)


def setup(free=50.0, inserted=150.0, **fields):
    return Setup(needle=NITINOL, tissue=VISCOUS, free_mm=free, inserted_mm=inserted, **fields)


@pytest.mark.parametrize("arrangement", list(Arrangement))
def test_springs_in_series_are_the_torsion_of_a_shaft_that_is_stiffer_at_its_base(arrangement):
    """Stiffness k (1 + s / L) at a distance s from the tip: integral L ln 2 / k, midpoints to 1e-3."""
    needle = NITINOL.but(stiffness_along=(1.0, 2.0), stiffness_along_mm=200.0)
    own = Setup(
        needle=needle,
        tissue=VISCOUS,
        free_mm=50.0,
        inserted_mm=150.0,
        discretisation=Discretisation(elements=40, arrangement=arrangement),
    )
    twist = float(np.sum(1 / springs_n_m_per_rad(own)))
    assert twist == pytest.approx(0.2 * math.log(2.0) / 323.5764e-6, rel=1e-3)


def test_play_and_grip_of_the_chuck_are_half_angles_in_rad_and_torques_in_n_m():
    head = header(setup(drive=Drive(backlash_deg=6.0, grip_torque_n_mm=2.0)), rows=1)
    assert head[memory_map.H_BACKLASH] == pytest.approx(math.radians(3.0))
    assert head[memory_map.H_GRIP] == pytest.approx(2e-3)
    assert head[memory_map.H_STOP] > 1e3  # rad: it slips without end


def test_a_needle_whose_bodies_do_not_hinge_on_one_another_lists_its_springs():
    siblings = setup(discretisation=Discretisation(arrangement=Arrangement.SIBLINGS))
    assert "needle_springs" not in numeric_fields(setup())
    assert numeric_fields(siblings)["needle_springs"].size == siblings.nodes_mm.size - 1


def test_a_joint_lies_where_it_is_measured_from_the_tip():
    """Middles of equal elements of 10 mm are 5, 15, 25, ... mm from the tip, the last element first."""
    own = Setup(
        needle=NITINOL.but(joint_play_deg=5.0, joint_from_tip_mm=20.0),
        tissue=VISCOUS,
        free_mm=50.0,
        inserted_mm=150.0,
        discretisation=Discretisation(elements=15),
    )
    at = header(own, rows=1)[memory_map.H_JOINT_AT]
    nodes = own.nodes_mm
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    assert np.interp(at, np.arange(middles.size), middles) == pytest.approx(nodes[-1] - 20.0)
