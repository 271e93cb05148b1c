"""Inputs of a step, from those at its start and at its end, in the interpreter."""

import numpy as np
import pytest

from models.drive import Drive
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup

FREE_M = 0.02
TISSUE = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)


@pytest.fixture
def read(interpreted, shaft_of):
    """`sim.kernel.stage.inputs` on named inputs; others are 0."""
    places, drive = interpreted.memory_map, Drive()
    cut = Discretisation(elements=4)
    shaft = shaft_of(
        Setup(needle=NITINOL, drive=drive, tissue=TISSUE, discretisation=cut, free_mm=20, inserted_mm=60)
    )
    head, idle = np.zeros(places.HEADER), np.zeros((1, places.COLUMNS))
    head[places.H_FREE_REF] = FREE_M

    def inputs(past, ctrl, law=idle):
        ends = []
        for named in (past, ctrl):
            values = np.zeros(places.INPUTS)
            for name, value in named.items():
                values[getattr(places, name)] = value
            ends.append(values)
        return interpreted.inputs.inputs_of(head, law, shaft, *ends)

    return inputs


@pytest.mark.parametrize(
    ("name", "field", "at_zero", "slope"),
    [
        ("U_CARRIAGE", "free", FREE_M, -1.0),
        ("U_INSERTED", "inserted", 0.0, 1.0),
        ("U_SPEED", "speed", 0.0, 1.0),
        ("U_TISSUE", "tissue", 1.0, 1.0),
    ],
)
def test_lengths_speed_and_tissue_are_those_of_the_middle(read, name, field, at_zero, slope):
    found = read({name: 0.004}, {name: 0.010})
    assert getattr(found, field) == pytest.approx(at_zero + slope * 0.007)


def test_the_drive_and_the_torque_at_the_tip_are_those_of_both_ends(read):
    found = read({"U_DRIVE": 0.1, "U_TIP": 1e-5}, {"U_DRIVE": 0.3, "U_TIP": 2e-5})
    assert found.drive_is == pytest.approx(3 * found.drive_was)
    assert found.tip_is == pytest.approx(2 * found.tip_was)
    assert found.drive_was != 0.0
    assert found.tip_was != 0.0


def test_a_tip_carries_torque_if_and_only_if_an_input_or_a_row_there_says_so(interpreted, read):
    places = interpreted.memory_map
    at_tip = np.zeros((1, places.COLUMNS))
    at_tip[0, places.L_POINT] = at_tip[0, places.L_TOP_INSERTED] = 1.0
    at_entry = np.zeros((1, places.COLUMNS))
    at_entry[0, places.L_POINT] = 1.0
    assert not read({}, {}).tip_loaded
    assert read({}, {"U_TIP": 1e-5}).tip_loaded
    assert read({"U_TIP": 1e-5}, {}).tip_loaded
    assert read({}, {}, at_tip).tip_loaded
    assert not read({}, {}, at_entry).tip_loaded
