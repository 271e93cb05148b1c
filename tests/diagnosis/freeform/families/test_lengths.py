"""Free laws of the inserted length."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.lengths import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.sensing.sensors import driven
from diagnosis.replay.variables import Variable
from sim.schedule import Schedule

ANGLE = turns(6.0)
TIME = 0.01 * np.arange(ANGLE.size)
STILL = covered(ANGLE, tip=ANGLE)
MOVING = replace(
    STILL, ends={**STILL.ends, Variable.DEPTH: (40.0, 90.0), Variable.AXIAL_SPEED: (-2.0, 4.0)}
)
FAMILIES = {family.name: family for family in families(MOVING)}
DEPTH, SPEED = "inserted length over depth", "inserted length over axial_speed"


def schedule(depth_mm, speed_mm_s):
    return Schedule(
        time_s=TIME,
        drive=ANGLE,
        free_mm=150.0 - depth_mm,
        inserted_mm=depth_mm,
        speed_mm_s=np.full(TIME.size, speed_mm_s),
    )


def test_at_one_length_and_at_rest_neither_is_asked_for():
    assert families(STILL) == ()
    assert set(FAMILIES) == {DEPTH, SPEED}


def test_a_length_that_is_right_everywhere_is_the_logged_one():
    for family in FAMILIES.values():
        none = [0.0] * len(family.effect.parameters)
        assert same_readings(ANGLE, family.effect.apply(NOMINAL, *none), NOMINAL)
        assert not same_readings(ANGLE, family.effect.apply(NOMINAL, 5.0, *none[1:]), NOMINAL)


def test_what_is_inserted_more_is_free_less():
    """A stage that moves by 2 % less, which was at 65 mm when it was zeroed."""
    family = FAMILIES[DEPTH]
    line = [0.0, -0.5, *[0.0] * (len(family.effect.parameters) - 2)]
    places, error = family.curve(*line)
    np.testing.assert_allclose(error, -0.02 * (np.asarray(places) - 65.0), atol=1e-9)
    depth = np.linspace(40.0, 90.0, TIME.size)
    found = driven(family.effect.apply(NOMINAL, *line), schedule(depth, 1.0))
    np.testing.assert_allclose(found.inserted_mm, depth - 0.02 * (depth - 65.0), atol=1e-6)
    np.testing.assert_allclose(found.inserted_mm + found.free_mm, 150.0)


@pytest.mark.parametrize(("change", "inserted"), [(-500.0, 0.0), (500.0, 150.0)])
def test_there_is_no_more_shaft_than_there_is(change, inserted):
    family = FAMILIES[SPEED]
    rig = family.effect.apply(NOMINAL, change, *[0.0] * (len(family.effect.parameters) - 1))
    found = driven(rig, schedule(np.full(TIME.size, 60.0), 1.0))
    np.testing.assert_allclose(found.inserted_mm, inserted, atol=1e-9)
