"""Free laws of a session: what changes from trial to trial."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import DAMPING, covered_by

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.session import FEWEST_TRIALS, families
from diagnosis.log.trial import SENSORS, TIP, TORQUE
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import COARSE
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

ANGLE = turns(6.0)
REST = np.zeros(ANGLE.size)
LASTS_S = 0.01 * (ANGLE.size - 1)
RANGES = covered_by([(ANGLE, ANGLE, (REST, REST))] * 3)
BOTH = replace(RANGES, missing={TIP: 2.0, TORQUE: 0.3})
FAMILIES = {f.name: f for f in families(BOTH)}
TIME, TURNS, DRY, STIFF = (
    "damping over time, of the session",
    "damping over history, of the session",
    "dry friction over time, of the session",
    "stiffness over time, of the session",
)
GAINS = ("tip gain over time, of the session", "torque gain over time, of the session")


def reads(rig, number):
    own = prepared(trial(ANGLE[::4], name=f"trial_{number:02d}.csv", step=0.04))
    return predict(RIG, own, [rig], COARSE)[0]


def same(rig, other, number):
    found, expected = reads(rig, number), reads(other, number)
    return all(
        np.allclose(found[s], expected[s], rtol=0, atol=1e-6 * np.ptp(expected[s])) for s in SENSORS
    )


PAUSE_S = 3.0


def law_of(name, *c, pause_s=PAUSE_S):
    """The parameters of a family: of time, with a pause; coordinates that are not given are 0."""
    values = [*([] if name == TURNS else [pause_s]), *c]
    return [*values, *[0.0] * (len(FAMILIES[name].effect.parameters) - len(values))]


def test_of_two_trials_no_session_is_told():
    assert families(covered_by([(ANGLE, ANGLE, (REST, REST))] * (FEWEST_TRIALS - 1))) == ()
    assert set(FAMILIES) == {TIME, TURNS, DRY, STIFF, *GAINS}


@pytest.mark.parametrize("name", ["tip", "torque"])
def test_a_gain_that_is_the_same_in_all_trials_is_a_wrong_gain(name):
    family = FAMILIES[f"{name} gain over time, of the session"]
    rig = family.effect.apply(NOMINAL, *law_of(family.name, np.log(1.1)))
    scale = "tip_angle_scale" if name == "tip" else "torque_scale"
    for number in (1, 3):
        assert same(rig, LIBRARY[scale].apply(NOMINAL, 1.1), number)
    assert family.place is Place.SENSOR


def test_a_gain_that_grows_does_so_from_trial_to_trial():
    """A straight line of the logarithm over the session, from -0.1 to 0.1."""
    name = GAINS[0]
    session_s = 3 * LASTS_S + 2 * PAUSE_S
    growing = FAMILIES[name].effect.apply(NOMINAL, *law_of(name, 0.0, 0.1))
    for number in (1, 2, 3):
        found, plain = reads(growing, number), reads(NOMINAL, number)
        end_s = number * LASTS_S + (number - 1) * PAUSE_S
        factor = np.exp(0.1 * (2.0 * end_s / session_s - 1.0))
        assert found.tip_angle_deg[-1] == pytest.approx(factor * plain.tip_angle_deg[-1], rel=2e-3)
        np.testing.assert_array_equal(found.base_torque_n_mm, plain.base_torque_n_mm)


@pytest.mark.parametrize("name", [TIME, TURNS])
def test_damping_that_is_the_same_in_all_trials_is_another_damping(name):
    rig = FAMILIES[name].effect.apply(NOMINAL, *law_of(name, np.log(1.3)))
    for number in (1, 2, 3):
        assert same(rig, RigParameters(damping_scale=1.3), number)
        assert not same(rig, NOMINAL, number)


def test_friction_that_is_the_same_in_all_trials_is_that_of_the_library():
    size = len(FAMILIES[DRY].effect.parameters)
    rig = FAMILIES[DRY].effect.apply(NOMINAL, 0.001, PAUSE_S, *[0.0] * (size - 2))
    assert same(rig, RigParameters(kinetic_n_mm_per_mm=0.001), 2)


def test_a_stiffness_that_is_the_same_in_all_trials_is_another_stiffness():
    rig = FAMILIES[STIFF].effect.apply(NOMINAL, *law_of(STIFF, np.log(1.2)))
    for number in (1, 2, 3):
        assert same(rig, RigParameters(stiffness_scale=1.2), number)
        assert not same(rig, NOMINAL, number)


@pytest.mark.parametrize("name", [TIME, TURNS])
def test_the_next_trial_begins_where_the_last_one_ended_but_for_the_pause(name):
    family, values = FAMILIES[name], law_of(name, 0.0, 0.5, 2.0)
    curves = family.effect.apply(NOMINAL, *values).free.curves
    places, damping = family.curve(*values)
    if name == TURNS:
        for before, after in pairwise(curves):
            assert before.values[-1] == pytest.approx(after.values[0])
    assert curves[0].values[0] == pytest.approx(damping[0] / DAMPING)
    assert curves[-1].values[-1] == pytest.approx(damping[-1] / DAMPING)
    total = 3 * LASTS_S + 2 * PAUSE_S if name == TIME else 3 * np.abs(np.diff(ANGLE)).sum() / 360
    assert max(places) == pytest.approx(total, rel=0.01)
    if name == TIME:
        again = (LASTS_S + PAUSE_S) * np.arange(3)
        expected = np.interp(again, places, damping) / DAMPING
        assert [curve.values[0] for curve in curves] == pytest.approx(list(expected), rel=1e-6)


def test_what_wears_is_the_interface_and_what_dries_the_tissue():
    assert {name: (f.place, f.says) for name, f in FAMILIES.items()} == {
        TIME: (Place.TISSUE, "time"),
        TURNS: (Place.INTERFACE, "history"),
        DRY: (Place.INTERFACE, "time"),
        STIFF: (Place.PARAMETERS, "time"),
        **dict.fromkeys(GAINS, (Place.SENSOR, "time")),
    }


def test_a_sensor_that_was_not_read_has_no_gain():
    assert {f.name for f in families(replace(BOTH, missing={TIP: 2.0}))} == {*FAMILIES} - {GAINS[1]}


def test_a_weaker_law_changes_the_stiffness_less():
    family = FAMILIES[STIFF]
    rig = family.effect.apply(NOMINAL, *law_of(STIFF, np.log(1.44)))
    half = replace(rig, free=rig.free.times(0.5))
    assert same(half, RigParameters(stiffness_scale=1.2), 1)
