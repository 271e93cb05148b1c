"""Steered insertions: what torsion costs, and what its compensation gives back."""

from functools import cache

import numpy as np
import pytest

from studies.control.steering.steered_insertions import (
    PUBLISHED_MM,
    TurnOrder,
    half_turns,
    steered_insertions,
)


@cache
def heights(order):
    made = steered_insertions(order, controllers=("base_only", "feedforward"))
    return {one.name: one.out_of_plane_mm for one in made}


@pytest.mark.parametrize(
    ("order", "rolls"),
    [(TurnOrder.TO_AND_FRO, [0, 180, 0, 180, 0]), (TurnOrder.WINDING, [0, 180, 360, 540, 720])],
)
def test_the_reference_makes_four_half_turns_on_the_way_to_seven_centimetres(order, rolls):
    inputs = half_turns(order)
    jumps = np.flatnonzero(np.diff(inputs.drive))
    assert inputs.inserted_mm[jumps] == pytest.approx([10, 20, 30, 40])
    assert [inputs.drive[0], *inputs.drive[jumps + 1]] == rolls
    assert inputs.inserted_mm[-1] == 70.0
    assert inputs.free_mm + inputs.inserted_mm == pytest.approx(120.0)


def test_turned_to_and_fro_every_transit_leaves_the_plane_by_the_same_side():
    steered = steered_insertions(TurnOrder.TO_AND_FRO, controllers=("base_only",))[-1]
    height = steered.path_mm[:, 2]
    assert height.min() > -1e-3
    # Each transit bends the path upwards once more: it never comes back.
    assert np.all(np.diff(height) > -1e-3)


def test_compensation_takes_the_share_of_the_deviation_that_the_paper_reports():
    found = heights(TurnOrder.TO_AND_FRO)
    published = PUBLISHED_MM["feedforward"] / PUBLISHED_MM["base_only"]
    # 1/3 from two heights printed in whole millimetres: (4 +- 0.5) / (12 +- 0.5).
    assert found["feedforward"] / found["base_only"] == pytest.approx(published, abs=0.06)
    assert found["baseline_right"] < 1e-9


def test_wound_on_in_one_sense_the_transits_cancel_and_the_needle_stays_near_the_plane():
    winding, fro = heights(TurnOrder.WINDING), heights(TurnOrder.TO_AND_FRO)
    assert winding["base_only"] < 0.2 * fro["base_only"]
    assert winding["feedforward"] < 0.4 * winding["base_only"]
