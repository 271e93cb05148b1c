"""What the passive callback does to MuJoCo's data, in the interpreter."""

from types import SimpleNamespace

import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.law_table import law_table
from sim.needles.setup import Setup
from sim.spec import needle_spec

STEP_S = 0.01


@pytest.fixture
def moment(interpreted, arrays_of):
    """A needle with dry friction at rest; its `update` at a time, with a turn of the drive."""
    setup = Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=0.02, kinetic_n_mm_per_mm=0.001),
        discretisation=Discretisation(elements=3, step_s=STEP_S),
        free_mm=20,
        inserted_mm=60,
    )
    model, places = needle_spec(setup).compile(), interpreted.memory_map
    n = setup.nodes_mm.size - 1
    rows = len(law_table(setup.needle, setup.drive, setup.tissue, rows=setup.rows))
    needle = arrays_of(model)
    userdata, size = np.zeros(places.userdata(n, rows)), places.block(n, rows)

    def at(time_s, turn_rad):
        passive, ctrl = np.zeros(n + 2), np.zeros(places.INPUTS)
        ctrl[places.U_DRIVE], ctrl[places.U_INSERTED] = turn_rad, 0.06
        qpos, qvel = np.zeros(n + 2), np.zeros(n + 2)
        interpreted.update.update(
            model.numeric_data, needle, STEP_S, time_s, qpos, qvel, ctrl, userdata, passive
        )
        now = userdata[places.CLOCK : places.CLOCK + size].copy()
        after = userdata[places.CLOCK + size : places.CLOCK + 2 * size].copy()
        return SimpleNamespace(passive=passive, now=now, after=after)

    return at


def test_asked_again_at_the_same_time_it_answers_the_same(moment):
    """MuJoCo may evaluate a moment as often as it likes."""
    first = moment(0.0, 0.2)
    again = moment(0.0, 0.2)
    assert np.array_equal(first.passive, again.passive)
    assert np.array_equal(first.after, again.after)
    assert np.abs(first.passive[1:]).max() > 0.0


def test_the_end_of_a_step_is_the_start_of_the_next_one_once_time_has_moved_on(interpreted, moment):
    places = interpreted.memory_map
    end = moment(0.0, 0.2).after
    then = moment(STEP_S, 0.2).now
    landing = places.O_LANDING  # the largest so far is kept apart
    assert np.array_equal(np.delete(then, landing), np.delete(end, landing))


def test_before_the_first_step_everything_rests(interpreted, moment):
    places = interpreted.memory_map
    now = moment(0.0, 0.2).now
    inputs = slice(places.B_INPUTS, places.B_INPUTS + places.INPUTS)
    assert now[inputs][places.U_INSERTED] == 0.06
    assert not now[: places.B_INPUTS].any()
    assert not now[places.B_ANGLES :].any()
