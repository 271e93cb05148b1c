"""Steered insertions: what torsion costs, and what its compensation gives back."""

import math

import numpy as np
import pytest

from studies.control import steering
from studies.control.steering import PlaneApproach

COMPARED = ("its own simulation", "torsion left out", "torsion compensated")


def test_the_reference_makes_four_half_turns_on_the_way_to_seven_centimetres():
    inputs = steering.half_turns()
    assert (inputs.drive[0], inputs.drive[-1], inputs.inserted_mm[-1]) == (0.0, 720.0, 70.0)
    jumps = np.flatnonzero(np.diff(inputs.drive) > 0)
    assert inputs.inserted_mm[jumps] == pytest.approx([10, 20, 30, 40])
    assert inputs.free_mm + inputs.inserted_mm == pytest.approx(120.0)


def test_half_turns_leave_the_plane_less_with_compensation():
    found = {
        s.name: s.out_of_plane_mm
        for s in steering.steered_insertions(controllers=("base_only", "feedforward"))
    }
    assert found["baseline_right"] < 1e-9
    assert found["feedforward"] < 0.4 * found["base_only"]  # published: 4 of 12 mm


def test_the_planar_controller_suffers_from_torsion_and_not_from_compensated_torsion():
    approaches = {p.name: p for p in steering.approach_plane(speed_mm_s=7.5, cases=COMPARED)}
    alone = approaches["its own simulation"].converged_mm()
    assert approaches["torsion left out"].converged_mm() > 1.8 * alone  # "twice as long"
    assert approaches["torsion compensated"].converged_mm() < 1.1 * alone


@pytest.mark.parametrize(
    ("heights", "travel"), [([3, 1, 0.4, 0.6, 0.1], 4.0), ([0.1, 0.2], 0.0), ([0.1, 0.9], math.nan)]
)
def test_convergence_is_the_travel_after_which_the_tip_stays_near_the_plane(heights, travel):
    travelled = np.arange(len(heights), dtype=float)
    made = PlaneApproach(name="x", travelled_mm=travelled, height_mm=np.array(heights))
    assert made.converged_mm() == pytest.approx(travel, nan_ok=True)
