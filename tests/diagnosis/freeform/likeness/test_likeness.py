"""Which plain law a curve looks like: recovered from points that scatter as their bands say."""

import re
from dataclasses import replace

import numpy as np
import pytest

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.likeness.likeness import LIBRARY_LAWS, likeness_of, plain_laws_of, recognised
from diagnosis.freeform.likeness.shapes import LINE

RATES = np.geomspace(0.006, 3.0, 7)
TIMES = np.linspace(0.0, 10.0, 8)
SIGNED = np.linspace(-5.0, 5.0, 11)
PLACES = (np.arange(6) + 0.5) / 6
ANGLES = 30.0 * np.arange(12)
BAND = 0.03  # half of it, of the range of the curve
SEEDS = range(10)
DRY, VISCOUS = "N mm / mm", "N mm s / rad / mm"


def curve(x, y, half, *, variable, place=Place.INTERFACE, unit="-"):
    """A law by points with a band."""
    low, high = (tuple(y + side * half) for side in (-1, 1))
    return Law(
        place=place,
        variable=variable,
        title="friction",
        x_unit="rad/s" if variable == "rate" else "-",
        unit=unit,
        x=tuple(x),
        y=tuple(y),
        low=low,
        high=high,
    )


def sine(x, mean, size, cycles, phase):
    return mean + size * np.sin(np.radians(cycles * x + phase))


# Shape, variable, places, law, its parameters in the order in which they are told.
LAWS = [
    ("constant", "time", TIMES, lambda x, a: 0 * x + a, (2.0,)),
    ("straight line", "time", TIMES, lambda x, a, b: a + b * x, (1.0, 0.5)),
    ("parabola", "time", TIMES, lambda x, a, b, c: a + b * x + c * x**2, (1.0, -2.0, 0.4)),
    ("cubic", "torque", SIGNED, lambda x, a, b, c: a + b * x + c * x**3, (0.5, 0.2, 0.1)),
    ("line in the size of the variable", "torque", SIGNED, lambda x, a, b: a + b * abs(x), (0.5, 0.2)),
    ("hyperbola", "axial_speed", SIGNED, lambda x, a, half: a / (1 + abs(x / half)), (2.0, 0.8)),
    ("exponential approach", "time", TIMES, lambda x, a, b, t: a + b * np.exp(-x / t), (1, 3, 2.5)),
    ("exponential approach", "depth", TIMES, lambda x, a, b, t: a + b * np.exp(-x / t), (4, -3, 1.5)),
    (
        "sine wave",
        "tip_angle",
        ANGLES,
        lambda x, mean, size, phase: sine(x, mean, size, 1.0, phase),
        (1.0, 0.5, -46.0),
    ),
    ("sine wave", "base_angle", ANGLES, sine, (1.0, 0.5, 2.0, 132.0)),
    ("sine wave", "tip_angle", ANGLES, sine, (-1.0, 0.2, 3.0, -160.0)),
    ("dry and viscous friction", "rate", RATES, lambda x, a, b: a + b * x, (1.0, 0.5)),
    ("power law", "rate", RATES, lambda x, a, p: a * x**p, (1.0, 0.6)),
    (
        "Stribeck friction",
        "rate",
        RATES,
        lambda x, dry, more, rate: dry + more * np.exp(-((x / rate) ** 2)),
        (1.0, 0.8, 0.1),
    ),
]


def errors_of(law, x, parameters, sigma):
    """Standard errors of least squares at the true parameters, by Cramer and Rao."""
    own = np.array(parameters, float)
    steps = 1e-6 * np.eye(own.size)
    slopes = [(law(x, *(own + step)) - law(x, *(own - step))) / 2e-6 for step in steps]
    return np.sqrt(np.diag(np.linalg.inv(np.array(slopes) @ np.array(slopes).T))) * sigma


@pytest.mark.parametrize(("shape", "variable", "x", "law", "parameters"), LAWS)
def test_a_plain_law_is_recognised_with_its_parameters(shape, variable, x, law, parameters):
    clean = law(x, *parameters)
    half = BAND * max(np.ptp(clean), 1.0)
    sigma = half / 1.96  # the band is of 95 %
    errors = errors_of(law, x, parameters, sigma)
    told = []
    for seed in SEEDS:
        noise = np.random.default_rng(seed).normal(0, sigma, x.size)
        like = likeness_of(curve(x, clean + noise, half, variable=variable))
        assert like is not None
        assert like.shape == shape
        says = re.sub("37 %|at 0,|1 rad", "", like.says)  # numbers of the words
        numbers = re.findall(r"[-+]?\d+\.?\d*(?:e[-+]\d+)?", says)
        told.append([float(n) for n in numbers[: len(parameters)]])
    # Three digits are told; Stribeck's damping is fitted too, so that the others are less certain.
    away = np.abs(np.array(told) - parameters) - 0.005 * np.abs(parameters)
    assert (away < 5 * errors).all()
    assert not (np.abs(np.array(told) - 1.3 * np.array(parameters)) < 5 * errors).all()


def test_friction_that_is_less_at_rest_is_no_stribeck_friction():
    """It is that with numbers that no friction has, as near as may be."""
    clean = 1.0 - 0.8 * np.exp(-((RATES / 0.1) ** 2)) + 0.2 * RATES
    like = likeness_of(curve(RATES, clean, 0.06, variable="rate"))
    assert like is None or like.shape != "Stribeck friction"


@pytest.mark.parametrize(("x", "at"), [(PLACES, 0.5), (TIMES, 2.2), (TIMES, 8.0)])
def test_a_step_is_found_between_the_points_where_it_is(x, at):
    variable = "position" if x is PLACES else "time"
    clean = np.where(x > at, 3.0, 1.0)
    for seed in SEEDS:
        noise = np.random.default_rng(seed).normal(0, 0.06 / 1.96, x.size)
        like = likeness_of(curve(x, clean + noise, 0.06, variable=variable))
        level, more, place = (float(n) for n in re.findall(r"[-+]?\d+\.?\d*", like.says))
        assert like.shape == "step"
        assert level == pytest.approx(1.0, abs=0.1)
        assert more == pytest.approx(2.0, abs=0.15)
        assert x[x < at].max() < place < x[x > at].min()


@pytest.mark.parametrize(("x", "variable"), [(TIMES, "time"), (RATES, "rate"), (ANGLES, "tip_angle")])
def test_points_without_any_law_look_like_none(x, variable):
    """By chance a law of four parameters may still run through seven points, but rarely."""
    found = [
        likeness_of(curve(x, np.random.default_rng(seed).normal(size=x.size), 0.1, variable=variable))
        for seed in range(20)
    ]
    assert sum(like is not None for like in found) <= 1


def test_a_law_that_is_none_of_these_has_no_name():
    bump = 1.0 + np.exp(-(((TIMES - 5.0) / 1.5) ** 2))
    assert likeness_of(curve(TIMES, bump, 0.03, variable="time")) is None
    assert likeness_of(curve(TIMES, bump, 1.0, variable="time")).shape == "constant"  # the band hides it


@pytest.mark.parametrize("variable", ["direction", "event"])
def test_two_values_are_no_curve(variable):
    assert (
        likeness_of(curve(np.array([-1.0, 1.0]), np.array([1.0, 2.0]), 0.1, variable=variable)) is None
    )


@pytest.mark.parametrize(
    ("variable", "place", "unit", "law", "x", "effects"),
    [
        ("rate", Place.INTERFACE, DRY, lambda x: 1 + 0.5 * x, RATES, ("coulomb_friction",)),
        ("rate", Place.INTERFACE, DRY, lambda x: x**0.5, RATES, ("shear_thinning",)),
        ("rate", Place.INTERFACE, DRY, lambda x: 1 + np.exp(-((x / 0.1) ** 2)), RATES, ("stiction",)),
        ("rate", Place.DRIVE, "N mm", lambda x: x**0.5, RATES, ()),
        ("position", Place.TISSUE, VISCOUS, lambda x: 1.0 + (x > 0.5), PLACES, ("layered_tissue",)),
        ("position", Place.INTERFACE, DRY, lambda x: 1.0 + (x > 0.5), PLACES, ()),
        ("tip_angle", Place.NEEDLE, DRY, lambda x: np.sin(np.radians(x)), ANGLES, ("needle_curvature",)),
        ("tip_angle", Place.NEEDLE, "N mm", lambda x: np.sin(np.radians(x)), ANGLES, ()),
        (
            "tip_angle",
            Place.SENSOR,
            "deg",
            lambda x: 1 + 0.01 * x,
            ANGLES,
            ("tip_angle_scale", "tip_angle_bias"),
        ),
    ],
)
def test_where_the_library_has_the_law_its_effect_is_named(variable, place, unit, law, x, effects):
    told = curve(x, law(x), 0.02, variable=variable, place=place, unit=unit)
    assert likeness_of(told).library == effects


def test_a_torque_in_proportion_to_an_acceleration_is_no_damping():
    inertia = curve(RATES, 0.5 + 2.0 * RATES, 0.02, variable="rate", place=Place.NEEDLE, unit="N mm")
    assert likeness_of(inertia).library == ("tip_drag",)
    told = likeness_of(replace(inertia, x_unit="rad/s^2"))
    assert (told.shape, told.library) == (LINE, ())


def test_numbers_of_a_law_have_the_units_of_its_curve():
    line = curve(TIMES, 1.0 + 0.5 * TIMES, np.full(TIMES.size, 0.03), variable="time", unit="N mm")
    said = likeness_of(replace(line, x_unit="s")).says
    assert re.fullmatch(r"\S+ N mm at 0, changing by \+0\.5\S* N mm per s", said)
    share = likeness_of(replace(line, variable="history", x_unit="of the bonds broken")).says
    assert share.endswith("N mm per 1 of the bonds broken")
    assert likeness_of(replace(line, unit="-")).says.endswith(" per unit")
    bowl = curve(SIGNED, 2.0 + SIGNED**2, np.full(SIGNED.size, 0.1), variable="torque", unit="deg")
    said = likeness_of(replace(bowl, x_unit="N mm")).says
    assert said.endswith("x²) deg, where x is the torque in N mm")


def test_a_curve_that_grows_beyond_all_bounds_approaches_nothing():
    """An exponential that grows has no constant over which it falls to 37 %."""
    grows = np.exp(TIMES / 3.0)
    law = curve(TIMES, grows, np.full(TIMES.size, 0.02), variable="time")
    assert "exponential approach" not in [one.shape.name for one in recognised(law)]


def test_every_effect_that_is_named_is_in_the_library():
    assert {name for names in LIBRARY_LAWS.values() for name in names} <= set(LIBRARY)


@pytest.mark.parametrize("value", [0.0, 1e-6, 40.0])
def test_a_level_curve_resembles_no_law(value):
    assert recognised(curve(TIMES, np.full(TIMES.size, value), 0.03, variable="time")) == []


def test_where_more_than_a_curve_is_fitted_its_straight_line_is_one_that_may_be_the_law():
    x = np.linspace(0.0, 1.0, 12)
    bent = curve(x, 3.0 * np.sin(9.0 * x**2), 1e-3, variable="history")
    assert recognised(bent) == []
    (line,) = plain_laws_of(bent, 4)
    assert line.shape.name == LINE
    assert line.values == pytest.approx(np.polynomial.polynomial.polyfit(x, bent.y, 1), abs=1e-6)


def test_a_line_that_is_recognised_already_comes_once():
    x = np.linspace(0.0, 1.0, 12)
    names = [
        one.shape.name for one in plain_laws_of(curve(x, 1.0 + 2.0 * x, 0.05, variable="history"), 4)
    ]
    assert names.count(LINE) == 1


@pytest.mark.parametrize(("variable", "y"), [("direction", (1.0, 2.0)), ("time", (2.0,) * 12)])
def test_two_values_and_a_level_have_no_line(variable, y):
    x = np.linspace(-1.0, 1.0, len(y))
    assert plain_laws_of(curve(x, np.array(y), 0.05, variable=variable), 4) == []
