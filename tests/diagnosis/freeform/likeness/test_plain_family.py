"""Families whose curve is a plain law."""

import pickle

import numpy as np
import pytest
from free_forms import covered, family_of

from diagnosis.effects.effect import Place
from diagnosis.freeform.families import families_of
from diagnosis.freeform.family import kind_of
from diagnosis.freeform.fits.growth_factor import grown_over
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.likeness.likeness import Recognised
from diagnosis.freeform.likeness.plain_family import plain_family
from diagnosis.freeform.likeness.shapes import OF_ANY
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

LINE = next(shape for shape in OF_ANY if shape.name == "straight line")
APPROACH = next(shape for shape in OF_ANY if shape.name == "exponential approach")
STEP = next(shape for shape in OF_ANY if shape.name == "step")
TURNS = np.concatenate([np.linspace(0, 400, 300), np.linspace(400, -200, 400)])
SEEN = (0.5 * TURNS, 0.005 * TURNS)
RANGES = covered(TURNS, tip=0.9 * TURNS, torque=0.01 * TURNS, speed=2.0, seen=SEEN)
BENT = 0.2  # coordinate that bends a curve, and part of its size by which a line rises
SHAPED = [
    family
    for family in families_of(RANGES)
    if sum(bool(kind_of(p)) for p in family.effect.parameters) > 4
    and family.says not in ("direction", "event")
]


def started(family):
    """Values of a family's parameters; of those that shape its curve the second one bends it."""
    parameters = family.effect.parameters
    values = np.array([p.start[0] for p in parameters])
    second = [i for i, p in enumerate(parameters) if kind_of(p)][1]
    values[second] = parameters[second].from_fit(BENT)
    return values


def law_of(family, values):
    x, y = (np.asarray(own, float) for own in family.curve(*values))
    near = {"low": tuple(y - 1.0), "high": tuple(y + 1.0), "unit": "-", "x_unit": "-"}
    place = Place.SENSOR
    return Law(place=place, variable=family.says, title="law", x=tuple(x), y=tuple(y), **near)


def line_near(family, values):
    """A line through the middle of the curve, that rises by a fifth of its size."""
    law = law_of(family, values)
    x, y = np.array(law.x), np.array(law.y)
    slope = BENT * max(float(np.abs(y).max()), 1e-6) / float(np.ptp(x))
    return law, np.array([float(y.mean()) - slope * float(x.mean()), slope])


def is_line(family):
    """Whether a curve may be any line: one that repeats, or jumps or is 0 at 0, may not."""
    through_zero = family.name.startswith("drive slip over")
    jumps = family.name == "tip torque over rate"  # by its dry friction, which is no part of the curve
    return "every" not in family.name and "tip_angle" not in family.says and not (jumps or through_zero)


@pytest.mark.parametrize("family", [f for f in SHAPED if is_line(f)], ids=lambda family: family.name)
def test_the_rig_gets_the_values_of_the_law(family):
    """The curve of the rig that a plain law makes is the law, to 1e-3 of its range."""
    values = started(family)
    law, line = line_near(family, values)
    plain = plain_family(family, values, law, Recognised(shape=LINE, values=line))
    assert plain.shape == "straight line"
    own = [p.start[0] for p in plain.effect.parameters]
    np.testing.assert_allclose(own[:2], line)
    x, y = plain.curve(*own)
    np.testing.assert_allclose(y, line[0] + line[1] * np.asarray(x))
    through = plain.effect.apply.args[0]
    made = np.asarray(family.curve(*through.coordinates(own))[1])
    assert np.abs(made - y).max() < 1e-3 * np.ptp(y)
    rig = RigParameters()
    assert plain.effect.apply(rig, *own) == family.effect.apply(rig, *through.coordinates(own))


def test_families_that_may_be_lines_are_of_all_places():
    places = {place for family in filter(is_line, SHAPED) for place in family.places}
    assert places == set(Place)


def test_what_the_curve_does_not_depend_on_stays_a_parameter():
    family = next(f for f in SHAPED if f.name == "elastic tissue over time")
    values = started(family)
    law, line = line_near(family, values)
    plain = plain_family(family, values, law, Recognised(shape=LINE, values=line))
    *_, time_constant, follows = plain.effect.parameters
    names = ["shape 0", "shape 1", "time_constant", "follows"]
    assert [p.name for p in plain.effect.parameters] == names
    assert (time_constant.start, follows.start) == ((values[1],), (values[2],))
    rig = plain.effect.apply(RigParameters(), *line, 0.7, 0.2)
    assert (rig.tissue_time_constant_s, rig.free.viscosity_exponent) == (0.7, 0.2)


def test_parameters_are_in_units_of_the_range_of_the_curve():
    """A line of slope 2 over 0 to 1 changes by its range, 2, for an offset of 2 or a slope of
    2 / rms(x).
    """
    family = family_of()
    values = np.zeros(8)
    values[1] = 1.0
    law = law_of(family, values)
    plain = plain_family(family, values, law, Recognised(shape=LINE, values=np.array([-1.0, 2.0])))
    offset, slope = plain.effect.parameters
    assert offset.scale == pytest.approx(2.0, rel=1e-6)
    assert slope.scale == pytest.approx(2.0 / np.sqrt(np.mean(np.array(law.x) ** 2)), rel=1e-6)


def test_a_curve_that_cannot_have_the_shape_has_no_plain_law():
    """A torque at the tip that has four waves in a turn has no step within three degrees."""
    family = next(f for f in SHAPED if f.name == "tip torque over tip_angle")
    law = law_of(family, started(family))
    step = np.array([0.0, 1.0, 0.0])
    assert plain_family(family, started(family), law, Recognised(shape=STEP, values=step)) is None


def test_a_law_that_does_not_depend_on_one_of_its_numbers_is_none():
    """An approach by nothing takes any time: no fit could find which."""
    family = next(f for f in SHAPED if f.name == "tip reading over time")
    law, _ = line_near(family, started(family))
    level = Recognised(shape=APPROACH, values=np.array([1.0, 0.0, 2.0]))
    assert plain_family(family, started(family), law, level) is None


def test_nor_has_one_with_as_many_parameters():
    family = family_of(family_of().effect.parameters[:2], curve=lambda a, b: ((0.0, 1.0), (a, b)))
    law = law_of(family, np.array([0.0, 1.0]))
    assert plain_family(family, np.zeros(2), law, Recognised(shape=LINE, values=np.zeros(2))) is None


def test_a_plain_law_keeps_the_factor_that_it_is_multiplied_by():
    base = next(f for f in SHAPED if f.name == "tip reading over tip_angle")
    family = grown_over(base, Variable.TIME, 0.0, 7.0)
    values = np.append(started(base), [0.0] * (len(family.effect.parameters) - started(base).size))
    values[started(base).size] = 0.4
    law, line = line_near(base, started(base))
    plain = plain_family(family, values, law, Recognised(shape=LINE, values=line))
    own = [p.start[0] for p in plain.effect.parameters]
    (curve,) = plain.effect.apply(RigParameters(), *own).free.curves
    x, y = plain.factor.curve(*own)
    np.testing.assert_allclose(curve.factor.values, y)
    np.testing.assert_allclose(y, family.factor.curve(*values)[1])
    assert plain.factor.name == plain.name
    assert np.ptp(y) > 0.5
    assert x[-1] == 7.0


def test_it_goes_to_another_process():
    family = next(f for f in SHAPED if f.name == "tip reading over tip_angle")
    values = started(family)
    law, line = line_near(family, values)
    plain = plain_family(family, values, law, Recognised(shape=LINE, values=line))
    again = pickle.loads(pickle.dumps(plain))
    assert again.effect.apply(RigParameters(), *line) == plain.effect.apply(RigParameters(), *line)
