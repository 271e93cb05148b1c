"""From a strength to parameters: by itself, inverse, of either sign, as a factor, with others."""

import math

import numpy as np
import pytest

from validation.logs.strengths.family import factor, inverse, only, periodic, signed, with_others


def drawn(draw, strength=4.0, count=40):
    return [draw(np.random.default_rng(seed))(strength) for seed in range(count)]


def test_the_strength_is_the_parameter_or_one_over_it():
    assert drawn(only("level"), count=1) == [{"level": 4.0}]
    assert drawn(inverse("torque"), count=1) == [{"torque": 0.25}]


def test_signs_and_factors_go_both_ways():
    assert {p["bias"] for p in drawn(signed("bias"))} == {-4.0, 4.0}
    logarithms = sorted({round(math.log(p["scale"]), 9) for p in drawn(factor("scale"))})
    assert logarithms == pytest.approx([-4.0, 4.0])


def test_others_are_drawn_in_their_ranges_and_stay_while_the_strength_changes():
    by_strength = with_others("level", speed=(1.0, 2.0))(np.random.default_rng(0))
    assert by_strength(1.0)["speed"] == by_strength(9.0)["speed"]
    assert all(1.0 <= p["speed"] <= 2.0 for p in drawn(with_others("level", speed=(1.0, 2.0))))
    cycles = {p["teeth"] for p in drawn(periodic("amplitude", "teeth", 3, 5))}
    assert cycles == {3.0, 4.0, 5.0}
