"""Plain laws: what a fit of each starts from."""

import numpy as np
import pytest

from diagnosis.freeform.likeness.shapes import OF_ANY, OF_BOTH_SIGNS, OF_RATE, of_angle

TURN = 30.0 * np.arange(12)
SHAPES = (*OF_RATE, *OF_ANY, *OF_BOTH_SIGNS, *of_angle(TURN))
X = np.linspace(0.1, 2.0, 12)
SAMPLE = {  # by name: parameters of a curve of that law
    "dry and viscous friction": (0.5, 0.2),
    "power law": (0.7, 0.6),
    "Stribeck friction": (0.4, 0.3, 0.5, 0.1),
    "constant": (0.3,),
    "line in the size of the variable": (0.3, -0.1),
    "parabola": (0.3, -0.1, 0.2),
    "cubic": (0.3, -0.1, 0.2),
    "hyperbola": (0.3, 0.8),
    "straight line": (0.1, 0.4),
    "exponential approach": (1.0, -0.8, 0.6),
    "step": (0.2, 0.5, 1.0),
    "sine wave": (0.1, 0.5, 17.0, 2.0),
}


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_a_start_has_a_value_for_each_parameter_that_words_name(shape):
    of_whole_cycles = shape.name == "sine wave" and "{3" not in shape.says
    values = SAMPLE[shape.name][: 3 if of_whole_cycles else None]
    start = shape.start(X, shape.law(X, *values))
    assert len(start) == len(values)
    assert np.isfinite(start).all()
    assert "{" not in shape.says.format(*start, x="", y="", per="", variable="")


def test_a_wave_starts_from_its_own_number_of_cycles():
    """Its amplitude, phase and mean are then those of a linear least squares, which is exact."""
    *_, wave = of_angle(TURN)
    degrees = np.linspace(-170.0, 180.0, 36)
    values = SAMPLE["sine wave"]
    np.testing.assert_allclose(wave.start(degrees, wave.law(degrees, *values)), values)


def test_a_step_starts_where_the_curve_jumps():
    shape = next(s for s in OF_ANY if s.name == "step")
    level, height, at = SAMPLE["step"]
    start = shape.start(X, shape.law(X, level, height, at))
    assert start[0] == pytest.approx(level, abs=1e-6)
    assert start[1] == pytest.approx(height, abs=1e-6)
    assert abs(start[2] - at) <= X[1] - X[0]


@pytest.mark.parametrize("cycles", [1, 2, 3, 4])
def test_a_wave_of_whole_cycles_has_no_parameter_for_them(cycles):
    wave = of_angle(TURN)[cycles - 1]
    values = SAMPLE["sine wave"][:3]
    np.testing.assert_allclose(wave.start(TURN, wave.law(TURN, *values)), values)
    assert ("sin(angle" if cycles == 1 else f"sin({cycles} angle") in wave.says


def test_a_curve_that_repeats_within_a_turn_may_be_a_wave_of_that_period():
    """Five places of a sixteenth of a turn; of a range of angles that is no part of one, none."""
    tooth = 360.0 / 16 * np.arange(5) / 5
    assert [w.says.count("sin(16 angle") for w in of_angle(tooth)] == [0, 0, 0, 0, 1, 0]
    assert len(of_angle(np.linspace(-40.0, 170.0, 12))) == 5
