"""What else would have changed the readings of a log in the same way: identities of linear needles."""

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, joined, log_of

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.equivalence.equivalent_sets import covers, equivalent_sets
from diagnosis.stopping import StopReason, StopSignal
from diagnosis.workers import Workers

SCALES = ("base_angle_scale", "damping_error", "stiffness_error", "tip_angle_scale", "torque_scale")
OTHERS = ("coulomb_friction", "tip_sensor_delay", "torque_bias")
STRONG = {
    "coulomb_friction": [np.log(0.001)],
    "tip_sensor_delay": [1.0],
    "damping_error": [np.log(1.2)],
    "stiffness_error": [np.log(1.2)],
    "tip_angle_scale": [np.log(1.1)],
    "torque_scale": [np.log(1.1)],
}


@pytest.fixture(scope="module")
def coarse():
    return coarse_of(joined(log_of(NOMINAL, seconds=6.0), log_of(NOMINAL, speed=-1.0, seconds=6.0)))


@pytest.fixture(scope="module")
def still():
    """A log of a needle that turns and never slides."""
    return coarse_of(log_of(NOMINAL, seconds=6.0))


def equal_to(coarse, *names):
    """Sets that are equivalent to these effects, all strong."""
    start = coarse.parameterization(names).joined({n: np.array(STRONG[n]) for n in names})
    best = candidate(fit_effects(coarse, names, start, most_iterations=0))
    assert best.names == names
    found = equivalent_sets(coarse, best, (*SCALES, *OTHERS), Workers())
    assert all(one.cost < 0.1 for one in found)  # identities: only inertia, 1e-6 of any torque, is left
    return {frozenset(one.names): one.parts for one in found}


def test_a_torque_gain_is_stiffness_and_damping_off_alike_and_both_gains_of_angles(coarse):
    found = equal_to(coarse, "torque_scale")
    assert set(found) == {
        frozenset(("stiffness_error", "damping_error")),
        frozenset(("base_angle_scale", "tip_angle_scale")),
    }
    for part in found[frozenset(("stiffness_error", "damping_error"))].values():
        if part.size and part[0] != 0:
            assert part[0] == pytest.approx(np.log(1.1), abs=1e-3)


def test_stiffness_off_alone_is_a_torque_gain_and_damping_the_other_way(coarse):
    found = equal_to(coarse, "stiffness_error")
    pair = found[frozenset(("torque_scale", "damping_error"))]
    assert pair["torque_scale"][0] == pytest.approx(np.log(1.2), abs=1e-3)
    assert pair["damping_error"][0] == pytest.approx(-np.log(1.2), abs=1e-3)


def test_two_that_are_off_alike_are_one_torque_gain(coarse):
    found = equal_to(coarse, "damping_error", "stiffness_error")
    assert frozenset(("torque_scale",)) in found
    assert not any(names > {"torque_scale"} for names in found)


def test_stiffness_and_damping_that_every_fit_leaves_open_may_be_a_torque_gain_beside_friction(coarse):
    """Their scatter beside friction alone does nearly the same, which hides the gain from small sets."""
    gain, level = np.log(1.22), np.log(0.0015)
    parts = {
        "coulomb_friction": np.array([level]),
        "stiffness_error": np.array([gain]),
        "damping_error": np.array([gain]),
    }
    start = coarse.parameterization(("coulomb_friction",)).joined(parts)
    best = candidate(fit_effects(coarse, ("coulomb_friction",), start, most_iterations=0))
    assert set(best.scatter_named) == {"stiffness_error", "damping_error"}
    found = equivalent_sets(coarse, best, (*SCALES, *OTHERS), Workers())
    (alike,) = [one for one in found if set(one.names) == {"coulomb_friction", "torque_scale"}]
    assert not alike.told_apart
    assert alike.parts["torque_scale"][0] == pytest.approx(gain, abs=1e-3)
    assert alike.parts["coulomb_friction"][0] == pytest.approx(level - gain, abs=1e-2)


def test_a_torque_gain_beside_a_late_torque_and_a_rough_bearing_is_stiffness_and_damping(coarse):
    """Secants beside half of a delay do not add up where the bearing turns its torque round."""
    names = ("torque_sensor_delay", "drive_friction", "torque_scale")
    strong = {
        "torque_sensor_delay": [0.15 / coarse.library["torque_sensor_delay"].parameters[0].scale],
        "drive_friction": [np.log(1.0)],
        "torque_scale": [np.log(0.8)],
    }
    start = coarse.parameterization(names).joined({n: np.array(own) for n, own in strong.items()})
    best = candidate(fit_effects(coarse, names, start, most_iterations=0))
    found = equivalent_sets(coarse, best, (*SCALES, *names[:2]), Workers())
    (alike,) = [one for one in found if {"stiffness_error", "damping_error"} <= set(one.names)]
    assert set(alike.names) == {*names[:2], "stiffness_error", "damping_error"}
    assert alike.parts["drive_friction"][0] == pytest.approx(np.log(0.8), abs=0.05)
    assert alike.parts["stiffness_error"][0] == pytest.approx(np.log(0.8), abs=0.05)


@pytest.mark.parametrize(("stiffness", "nearly"), [(1.1, False), (1.105, True), (1.3, None)])
def test_fewer_effects_that_are_nearly_alike_are_told_as_that(coarse, stiffness, nearly):
    """A gain of the base, a stiffness and a damping, all of 1.1, are one gain of the tip."""
    parts = {"base_angle_scale": 1.1, "stiffness_error": stiffness, "damping_error": 1.1}
    names = tuple(parts)
    start = coarse.parameterization(names).joined({n: np.array([np.log(v)]) for n, v in parts.items()})
    best = candidate(fit_effects(coarse, names, start, most_iterations=0))
    found = equivalent_sets(coarse, best, (*SCALES, *OTHERS), Workers())
    told = {one.names: one.told_apart for one in found}
    assert told.get(("tip_angle_scale",)) is nearly
    assert all(len(own) < len(names) for own, apart in told.items() if apart)


@pytest.mark.parametrize("level", [2e-4, 1e-3, 5e-3])
@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("coulomb_friction", "speed_dependent_friction"),
        ("speed_dependent_friction", "coulomb_friction"),
    ],
)
def test_where_a_needle_never_slides_two_laws_of_dry_friction_are_one(still, one, other, level):
    """However strong it is: what friction changes is not straight, and sets are sought by secants."""
    start = still.parameterization([one]).joined({one: np.array([np.log(level)])})
    best = candidate(fit_effects(still, [one], start, most_iterations=0))
    found = equivalent_sets(still, best, ("coulomb_friction", "speed_dependent_friction"), Workers())
    assert [e.names for e in found] == [(other,)]
    assert found[0].cost < 1e-3  # of their fits: 0.01 of a standard deviation


@pytest.mark.parametrize("name", ["coulomb_friction", "tip_sensor_delay"])
def test_an_effect_of_its_own_kind_is_like_no_other(coarse, name):
    """Negative control."""
    assert equal_to(coarse, name) == {}


def test_the_nominal_rig_is_like_nothing(coarse):
    assert equivalent_sets(coarse, candidate(fit_effects(coarse, ())), SCALES, Workers()) == ()


def test_a_set_covers_what_is_in_it_or_contained_in_it():
    assert covers(("stiction", "tip_drag"), ("coulomb_friction",))
    assert not covers(("coulomb_friction",), ("stiction",))


def test_after_a_stop_nothing_is_told(coarse):
    start = coarse.parameterization(("torque_scale",)).joined({"torque_scale": np.log([1.1])})
    best = candidate(fit_effects(coarse, ("torque_scale",), start, most_iterations=0))
    stop = StopSignal()
    stop.request(StopReason.INTERRUPTED)
    assert equivalent_sets(coarse, best, SCALES, Workers(stop=stop)) == ()
