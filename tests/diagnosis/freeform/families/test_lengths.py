"""Free laws of the inserted length."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.lengths import families
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.sensing.sensors import driven
from diagnosis.replay.variables import Variable
from sim.schedule import Schedule

ANGLE = turns(6.0)
TIME = 0.01 * np.arange(ANGLE.size)
STILL = covered(ANGLE, tip=ANGLE)
MOVING = replace(
    STILL,
    ends={
        **STILL.ends,
        Variable.DEPTH: (40.0, 90.0),
        Variable.FREE: (60.0, 110.0),
        Variable.AXIAL_SPEED: (-2.0, 4.0),
        Variable.ADVANCED_BY: (0.0, 50.0),
    },
)
FAMILIES = {family.name: family for family in families(MOVING)}
DEPTH, SPEED = "inserted length over depth", "inserted length over axial_speed"
ADVANCED, FREE = "inserted length over advanced_by", "free length over free"
ONE_LIMIT = f"{ADVANCED}, up to one limit"


def schedule(depth_mm, speed_mm_s):
    return Schedule(
        time_s=TIME,
        drive=ANGLE,
        free_mm=150.0 - depth_mm,
        inserted_mm=depth_mm,
        speed_mm_s=np.full(TIME.size, speed_mm_s),
    )


def test_at_one_length_and_at_rest_only_an_error_of_the_free_length_is_asked_for():
    (only,) = families(STILL)
    assert only.name == FREE
    assert [p.name for p in only.effect.parameters] == ["error"]
    assert set(FAMILIES) == {DEPTH, SPEED, ADVANCED, ONE_LIMIT, FREE}


def test_a_free_length_that_is_longer_is_a_spring_in_the_drive():
    """Nothing acts on it: stiffness = rigidity / length, shorter than which no library has."""
    family = FAMILIES[FREE]
    spring = LIBRARY["base_compliance"].apply(NOMINAL, RIG.rigidity_n_mm2 / 12.0)
    assert same_readings(ANGLE, family.effect.apply(NOMINAL, 12.0, 0.0), spring, within=1e-3)
    assert not same_readings(ANGLE, family.effect.apply(NOMINAL, -12.0, 0.0), spring, within=1e-3)


def test_a_free_length_whose_scale_is_wrong_is_off_by_a_share_of_itself():
    family = FAMILIES[FREE]
    places, error = family.curve(3.0, 0.1)
    assert list(places) == [60.0, 110.0]
    np.testing.assert_allclose(error, [3.0 - 2.5, 3.0 + 2.5])
    depth = np.linspace(40.0, 90.0, TIME.size)
    found = driven(family.effect.apply(NOMINAL, 3.0, 0.1), schedule(depth, 1.0))
    logged = 150.0 - depth
    np.testing.assert_allclose(found.free_mm, logged + 3.0 + 0.1 * (logged - 85.0), atol=1e-9)
    np.testing.assert_array_equal(found.inserted_mm, depth)


def test_a_length_that_is_right_everywhere_is_the_logged_one():
    for family in FAMILIES.values():
        none = [0.0 if p.neutral == 0.0 else p.low for p in family.effect.parameters]
        assert same_readings(ANGLE, family.effect.apply(NOMINAL, *none), NOMINAL)
        if family.says == "axial_speed" and family.name != SPEED:  # of a needle at rest
            continue
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


def test_a_surface_goes_along_until_it_slides_and_back_by_twice_that():
    """Of one limit: the advance takes it up once, and the way back twice."""
    family = FAMILIES[ADVANCED]
    shares = (*[0.0] * (len(family.effect.parameters) - 2), -1.0, 0.0)
    advance, error = family.curve(*shares)
    limit = advance[-2]
    np.testing.assert_allclose(error, -np.minimum(advance, limit))
    depth = 40.0 + np.concatenate([np.linspace(0, 50, 300), np.linspace(50, 0, TIME.size - 300)])
    rig = family.effect.apply(NOMINAL, *shares)
    moved = driven(rig, schedule(depth, 1.0)).inserted_mm
    there, back = depth[:300], depth[300:]
    np.testing.assert_allclose(moved[:300], there - np.minimum(there - 40.0, limit), atol=1e-6)
    np.testing.assert_allclose(moved[300:], back - np.maximum(limit - (90.0 - back), -limit), atol=1e-6)


def test_up_to_one_limit_it_is_the_same_with_one_share_alone():
    several, one = FAMILIES[ADVANCED], FAMILIES[ONE_LIMIT]
    shares = (*[0.0] * (len(several.effect.parameters) - 2), -0.7, 0.0)
    advance, _ = several.curve(*shares)
    limit = float(advance[-2])
    depth = 65.0 + 25.0 * np.sin(np.linspace(0, 9, TIME.size))
    each = (
        driven(family.effect.apply(NOMINAL, *values), schedule(depth, 1.0)).inserted_mm
        for family, values in ((several, shares), (one, (-0.7, limit)))
    )
    np.testing.assert_allclose(*each, atol=1e-9)
    assert one.curve(-0.7, limit) == ((0.0, limit, 2 * limit), (0.0, -0.7 * limit, -0.7 * limit))
