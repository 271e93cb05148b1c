"""A delay line: the timelines of its own docstring."""

import math
import re

import pytest

from models.errors import InvalidValue
from sim.loop import delay_line
from sim.loop.delay_line import DelayLine


def timeline(name, nth=0):
    lines = re.findall(rf"^    {name} +(.*)$", delay_line.__doc__, flags=re.M)
    return lines[nth].split()[:6]


def test_the_timelines_of_the_docstring_are_what_happens():
    held, known = DelayLine(0.02, 0.01), DelayLine(0.02, 0.01, first="0")
    assert [held(value) for value in timeline("in")] == timeline("out")
    assert [known(value) for value in timeline("in")] == timeline("out", 1)


def test_without_delay_every_value_comes_out_at_once():
    line = DelayLine(0.0, 0.01, first=7.0)
    assert [line(x) for x in (1.0, 2.0, 3.0)] == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(("delay_s", "samples"), [(0.04, 20), (0.0409, 20), (0.0009, 0), (0.0011, 1)])
def test_a_delay_is_rounded_to_whole_samples(delay_s, samples):
    assert DelayLine(delay_s, 0.002).samples == samples


@pytest.mark.parametrize("bad", [-0.1, math.nan, math.inf])
def test_an_impossible_delay_is_refused(bad):
    with pytest.raises(InvalidValue, match="delay_s"):
        DelayLine(bad, 0.002)
