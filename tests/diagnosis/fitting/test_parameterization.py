"""Parameters of effects as a vector that a fit can move in."""

from dataclasses import replace

import numpy as np
import pytest

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.parameterization import Parameterization, parameterization_of, starts
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from models.errors import InvalidValue
from sim.needles.run import SimulationFailed

OPEN = tuple(LIBRARY[name] for name in SCATTER)


@pytest.mark.parametrize("name", LIBRARY)
def test_every_start_is_within_bounds_and_changes_the_rig(name):
    parameterization = parameterization_of([name])
    low, high = parameterization.bounds()
    for start in starts(LIBRARY[name]):
        assert np.all((low <= start) & (start <= high))
        assert parameterization.rig(start) != RigParameters()


@pytest.mark.parametrize("name", LIBRARY)
def test_values_survive_the_vector(name):
    parameterization = parameterization_of([name])
    for i, start in enumerate(starts(LIBRARY[name])):
        values = [p.start[i] for p in LIBRARY[name].parameters]
        assert parameterization.values(start) == pytest.approx(values)


def test_effects_stand_before_what_is_open():
    parameterization = parameterization_of(("stiction", "tip_drag"), OPEN)
    owners = ("stiction",) * 3 + ("tip_drag", *SCATTER)
    assert parameterization.owners == owners
    assert parameterization.free == 4
    assert [p.name for p in parameterization.parameters][:4] == [
        "kinetic",
        "static",
        "stribeck",
        "damping",
    ]


def test_only_what_is_open_has_a_prior():
    weights = parameterization_of(("tip_drag", "stiffness_error"), OPEN).weights
    np.testing.assert_allclose(weights, [0, 0, 1 / SCATTER["damping_error"]])


def test_parts_and_joined_undo_each_other():
    parameterization = parameterization_of(("stiction", "tip_drag"), OPEN)
    x = np.arange(1.0, 7.0)
    parts = parameterization.parts(x)
    assert {name: part.size for name, part in parts.items()} == {
        "stiction": 3,
        "tip_drag": 1,
    } | dict.fromkeys(SCATTER, 1)
    np.testing.assert_array_equal(parameterization.joined(parts), x)
    np.testing.assert_array_equal(parameterization.joined({"tip_drag": x[3:4]}), [0, 0, 0, 4, 0, 0])


def test_no_effect_is_the_nominal_rig():
    nothing = parameterization_of(())
    assert nothing.rig(np.zeros(0)) == NOMINAL
    assert nothing.parts(np.zeros(0)) == {}
    assert nothing.joined({}).size == 0
    assert parameterization_of((), OPEN).rig(np.zeros(2)) == NOMINAL


def test_what_rounding_left_beyond_a_bound_is_at_the_bound():
    """Beyond zero a law would be refused: -7e-19 of a drag that may be none, say."""
    drag = Parameter(name="damping", unit="-", low=0.0, high=2.0, start=(1.0,), scale=1.0)
    effect = replace(LIBRARY["tip_drag"], parameters=(drag,))
    own = Parameterization(effects=(effect,), nuisance=())
    assert own.values(np.array([-7e-19])) == [0.0]
    assert own.values(np.array([2.0 + 1e-15])) == [2.0]
    assert own.values(np.array([-1e-6])) == [-1e-6]
    assert own.values(np.array([0.5])) == [0.5]


def test_where_there_is_no_rig_nothing_can_be_simulated():
    """A law may be refused for values within its bounds; a fit then looks elsewhere."""

    def refuse(rig, value):
        raise InvalidValue("value", value, "nothing at all")

    refused = replace(LIBRARY["tip_drag"], apply=refuse)
    parameterization = Parameterization(effects=(refused,), nuisance=())
    with pytest.raises(SimulationFailed, match="nothing at all"):
        parameterization.rig(np.zeros(1))


def test_entries_at_a_bound_are_held():
    two = parameterization_of(("tip_sensor_delay", "tip_drag"))
    low, high = two.bounds()
    middle = 0.5 * (low + high)
    assert two.held(middle).tolist() == [False, False]
    assert two.held(np.array([low[0], high[1]])).tolist() == [True, True]
    assert two.held(np.array([middle[0], high[1]])).tolist() == [False, True]
