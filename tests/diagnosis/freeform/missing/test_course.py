"""The course of a law in words."""

from dataclasses import replace

import pytest
from free_forms import LAW

from diagnosis.freeform.missing.course import course_of


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({}, "friction along the shaft rises from 0.001 to 0.004 N mm / mm between 0.01 and 1 rad/s"),
        ({"y": (0.004, 0.002, 0.001)}, "friction along the shaft falls from 0.004 to 0.001 N mm"),
        ({"y": (0.001, 0.004, 0.0015)}, "friction along the shaft varies between 0.001 and 0.004"),
        ({"variable": "direction", "y": (0.001, 0.002)}, "is 2 times as strong forwards"),
        ({"variable": "direction", "y": (0.003, 0.002)}, "is 1.5 times as strong backwards"),
        (
            {"variable": "direction", "y": (0.00202, 0.002)},
            "is 0.002 N mm / mm, the same in both directions",
        ),
        ({"variable": "direction", "y": (-0.1, 0.2)}, "is 0.2 N mm / mm forwards, -0.1 N mm / mm back"),
        (
            {"variable": "event", "x": (0.0, 2.5, 2.6, 4.5), "y": (0.0, 0.0, 3.0, 3.0), "x_unit": "s"},
            "by 3 N mm / mm at 2.55 s",
        ),
        (
            {
                "variable": "event",
                "x": (0, 2.5, 2.6, 4.5),
                "y": (1, 1, 0.2, 0.2),
                "unit": "-",
                "x_unit": "s",
            },
            "along the shaft, 0.2 times as large at 2.55 s",
        ),
    ],
)
def test_the_course_of_a_law_is_told(changes, said):
    assert said in course_of(replace(LAW, **changes))


@pytest.mark.parametrize(
    ("x", "y", "said"),
    [
        ((0, 59.5, 60.5, 230), (0, 0, 80, 80), "steps from 0 to 80 N mm / mm at 60 mm from the tip"),
        ((0, 20, 60, 230), (0, 0, 80, 80), "rises from 0 to 80 N mm / mm between 0 and 230 mm"),
        ((0, 59.5, 60.5, 230), (0, 0, 80, 90), "rises from 0 to 90 N mm / mm between 0 and 230 mm"),
    ],
)
def test_a_step_is_told_with_its_place(x, y, said):
    law = replace(LAW, x=x, y=y, low=y, high=y, x_unit="mm from the tip")
    assert said in course_of(law)


def test_what_is_nothing_beside_its_range_is_told_as_zero():
    law = replace(LAW, x=(1.2e-21, 4.0, 8.0), x_unit="turns", y=(0.0, 1.0, 2.0))
    assert "between 0 and 8 turns" in course_of(replace(law, low=law.y, high=law.y))


def test_an_event_that_passes_is_told_by_the_level_that_it_comes_to():
    """Tissue that gives way, and recovers; a step one way, and back."""
    time_s = (-1.0, 4.9, 5.1, 6.0, 9.0)
    event = replace(LAW, variable="event", x=time_s, low=time_s, high=time_s, x_unit="s")
    recovers = replace(event, y=(1.0, 1.0, 0.4, 0.7, 1.0), unit="-")
    assert "0.4 times as large at 5.00 s" in course_of(recovers)
    back = replace(event, y=(0.0, 0.0, 5.0, 5.0, 0.0), unit="deg")
    assert "by 5 deg at 5.00 s" in course_of(back)


def test_a_law_of_one_layer_is_not_told_as_none_where_its_level_is_uncertain():
    """Nothing outside of the layer is certain; the level in it is known to a factor."""
    y, high = (0.0, 0.0, 0.004, 0.004, 0.0), (0.0, 0.0, 0.02, 0.02, 0.0)
    law = replace(LAW, x=(0.0, 50.0, 50.1, 60.0, 60.1), y=y, low=(0.0,) * 5, high=high)
    assert "varies between 0 and 0.004" in course_of(law)


def test_a_law_that_is_next_to_nothing_but_at_its_end_is_told_with_that_end():
    """Its median is far less than the width of its bands, which is less than what it comes to."""
    x, y = (-5.0, -2.0, 0.1, 2.0, 5.0), (-0.0002, 0.0001, 0.002, 0.3, 0.45)
    law = replace(LAW, x=x, y=y, low=tuple(v - 0.1 for v in y), high=tuple(v + 0.1 for v in y))
    assert "rises from -0.0002 to 0.45 N mm / mm between -5 and 5" in course_of(law)


def test_where_a_curve_is_not_determined_its_course_is_not_told():
    x, y, wide = (0.0, 1.0, 2.0, 3.0), (1.0, 1.5, 2.0, 400.0), (0.9, 1.4, 1.9, 0.0)
    law = replace(LAW, x=x, y=y, low=wide, high=(1.1, 1.6, 2.1, 9e4))
    assert "rises from 1 to 2 N mm / mm between 0 and 2" in course_of(law)
