"""Parameters of effects: their coordinates, and how far they are from neutral."""

import math

import numpy as np
import pytest

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter, slopes_at


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effect_at_no_strength_is_the_nominal_rig(name):
    parameters = LIBRARY[name].parameters
    assert not math.isnan(parameters[0].distance_from_neutral(parameters[0].start[0]))
    for p in parameters:
        start = p.start[0]
        if p.neutral is None:
            assert p.towards_neutral(start, 0.5) == start
            assert math.isnan(p.distance_from_neutral(start))
            continue
        assert p.towards_neutral(start, 1.0) == pytest.approx(start)
        weaker = p.towards_neutral(start, 0.3)
        assert p.distance_from_neutral(weaker) == pytest.approx(0.3 * p.distance_from_neutral(start))
        gone = p.towards_neutral(start, 1e-9)
        assert gone > 1e6 if math.isinf(p.neutral) else gone == pytest.approx(p.neutral, abs=1e-8)


@pytest.mark.parametrize("value", [-1.0, 0.0, 0.4, 1.0, 3.0])
def test_a_gain_that_may_be_zero_or_negative_goes_straight_to_one(value):
    """A sensor that clips, or reads the other way beyond a level: no power of its gain is a real one."""
    gain = Parameter(name="gain", unit="-", low=-2.0, high=5.0, start=(0.5,), neutral=1.0)
    weaker = gain.towards_neutral(value, 0.25)
    assert weaker == pytest.approx(1.0 + 0.25 * (value - 1.0))
    assert gain.distance_from_neutral(weaker) == pytest.approx(0.25 * abs(value - 1.0))


def test_an_effect_is_weakened_in_the_coordinates_of_a_fit():
    part = np.array([math.log(3.0), 0.35])
    weak = LIBRARY["layered_tissue"].weakened(part, 0.2)
    np.testing.assert_allclose(weak, [0.2 * math.log(3.0), 0.35])  # where they meet is a shape


@pytest.mark.parametrize("name", LIBRARY)
def test_a_value_survives_the_coordinate_of_a_fit(name):
    for p in LIBRARY[name].parameters:
        for value in (*p.start, p.high):
            assert p.from_fit(p.to_fit(value)) == pytest.approx(value)
        assert p.to_fit(p.low) < p.to_fit(p.high)


def test_a_parameter_over_decades_moves_in_its_logarithm_and_others_in_their_unit():
    wide = Parameter(name="level", unit="-", low=1e-6, high=1.0, start=(0.1,), logarithmic=True)
    narrow = Parameter(name="angle", unit="deg", low=-90, high=90, start=(5.0,), scale=10.0)
    assert wide.to_fit(0.1) == pytest.approx(math.log(0.1))
    assert narrow.to_fit(5.0) == 0.5


def test_slopes_are_those_of_central_differences():
    parameters = [p for effect in LIBRARY.values() for p in effect.parameters]
    x = np.array([p.to_fit(p.start[0]) for p in parameters])
    ahead, behind = (
        np.array([p.from_fit(own + s) for p, own in zip(parameters, x, strict=True)])
        for s in (1e-4, -1e-4)
    )
    # The cube of the difference over six, of an exponential.
    np.testing.assert_allclose(slopes_at(parameters, x), (ahead - behind) / 2e-4, rtol=1e-7)
