"""What is another one in each trial: in a trial it is an effect of the library."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import prepared, trial, turns
from free_forms import DAMPING, VOCABULARY, covered_by

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_time.trials import FEWEST_TRIALS, families
from diagnosis.log.trial import SENSORS, TIP, TORQUE
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import COARSE
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
REST = np.zeros(ANGLE.size)
RANGES = covered_by([(ANGLE, ANGLE, (REST, REST))] * 3)
FAMILIES = {f.name: f for f in families(replace(RANGES, missing={TIP: 2.0, TORQUE: 0.3}))}
GROWS = (0.0, 0.1, -0.2)
DRIFTS = {
    "tip reading over time, drifting in each trial": "tip reading over time, of each trial",
    "torque reading over time, drifting in each trial": "torque reading over time, of each trial",
}
LEVEL, LENGTH = 0.001, "inserted length over time, of each trial"
EFFECTS = {
    "tissue over time, of each trial": lambda c: ("damping_error", np.exp(c)),
    "stiffness over time, of each trial": lambda c: ("stiffness_error", np.exp(c)),
    "tip reading over time, of each trial": lambda c: ("tip_angle_bias", c),
    "tip gain over time, of each trial": lambda c: ("tip_angle_scale", np.exp(c)),
    "torque reading over time, of each trial": lambda c: ("torque_bias", c),
    "torque gain over time, of each trial": lambda c: ("torque_scale", np.exp(c)),
}


def reads(rig, number):
    own = prepared(trial(ANGLE[::4], name=f"trial_{number:02d}.csv", step=0.04))
    return predict(RANGES.problem.log.rig, own, [rig], COARSE)[0]


def same(one, other, within=1e-6):
    return all(np.allclose(one[s], other[s], rtol=0, atol=within * np.ptp(other[s])) for s in SENSORS)


def test_one_trial_has_nothing_to_differ_from():
    assert families(covered_by([(ANGLE, ANGLE, (REST, REST))] * (FEWEST_TRIALS - 1))) == ()
    assert set(FAMILIES) == {*EFFECTS, *DRIFTS, LENGTH, "dry friction over time, of each trial"}
    assert {family.says for family in FAMILIES.values()} <= VOCABULARY
    assert all(family.of_each_trial for family in FAMILIES.values())


@pytest.mark.parametrize("name", EFFECTS)
@pytest.mark.parametrize("number", [1, 2, 3])
def test_in_each_trial_it_is_an_effect_of_its_own_size(name, number):
    rig = FAMILIES[name].effect.apply(NOMINAL, *GROWS)
    effect, value = EFFECTS[name](GROWS[number - 1])
    assert same(reads(rig, number), reads(LIBRARY[effect].apply(NOMINAL, value), number), 1e-4)
    if number > 1:
        assert not same(reads(rig, number), reads(NOMINAL, number), 1e-4)


def test_where_more_is_inserted_the_tip_lags_more():
    rig = FAMILIES[LENGTH].effect.apply(NOMINAL, 0.0, 3.0, -3.0)
    same_depth, deeper, less_deep = (
        np.mean((reads(rig, n).tip_angle_deg - ANGLE[::4]) ** 2) for n in (1, 2, 3)
    )
    assert less_deep < same_depth < deeper


def test_dry_friction_is_that_of_the_library_in_each_trial():
    rig = FAMILIES["dry friction over time, of each trial"].effect.apply(NOMINAL, LEVEL, *GROWS)
    for number, c in enumerate(GROWS, start=1):
        own = LIBRARY["coulomb_friction"].apply(NOMINAL, LEVEL * np.exp(c))
        assert same(reads(rig, number), reads(own, number))


@pytest.mark.parametrize(("drifting", "offset"), DRIFTS.items())
def test_a_sensor_drifts_from_zero_in_each_trial(drifting, offset):
    """In the middle and at the end it reads as one with the offset of there."""
    ends = (0.2, 0.5, -0.1, 0.3, 0.0, 0.0)
    rig = FAMILIES[drifting].effect.apply(NOMINAL, *ends)
    for number in (1, 2, 3):
        middle, end = ends[2 * number - 2 : 2 * number]
        for share, size in ((0.0, 0.0), (0.5, middle), (1.0, end)):
            shifted = FAMILIES[offset].effect.apply(NOMINAL, size, size, size)
            at = round(share * (ANGLE[::4].size - 1))
            for sensor in SENSORS:
                seen, known = (reads(one, number)[sensor][at] for one in (rig, shifted))
                assert seen == pytest.approx(known, abs=0.01)
    number, told = FAMILIES[drifting].curve(*ends)
    np.testing.assert_allclose((number, told), ((1, 2, 3), (0.5, 0.3, 0.0)))


def test_curves_are_told_trial_by_trial():
    number, damping = FAMILIES["tissue over time, of each trial"].curve(*GROWS)
    np.testing.assert_allclose(number, (1, 2, 3))
    np.testing.assert_allclose(damping, DAMPING * np.exp(GROWS))
    _, offset = FAMILIES["tip reading over time, of each trial"].curve(*GROWS)
    np.testing.assert_allclose(offset, GROWS)
    _, level = FAMILIES["dry friction over time, of each trial"].curve(LEVEL, *GROWS)
    np.testing.assert_allclose(level, LEVEL * np.exp(GROWS))
