"""A delay of a sensor, or filters in its place."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import scored

from diagnosis.criteria.selection import PART_LEAD
from diagnosis.effects import IMPERFECTIONS
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.delay_or_filter import lags_little, takes_for_a_filter
from diagnosis.selection.verdicts.verdict import VerdictKind

BIAS = "tip_angle_bias"
STRONG_SIGMA = 2.0


def lagging(names, score, changes_sigma=STRONG_SIGMA):
    """A candidate at the noise floor whose filters change readings by so much."""
    one = scored(names, score)
    own = np.isin(one.fit.parameterization.owners, [name for name in names if name in IMPERFECTIONS])
    x = np.where(own, 0.5, one.fit.x)
    rows = np.zeros((one.fit.samples, x.size))
    rows[:, own] = changes_sigma / 0.5 / max(own.sum(), 1)
    return replace(one, fit=replace(one.fit, x=x, jacobian=(rows,)))


def verdict(*each):
    """On candidates at the noise floor, by names, score and what their filters change."""
    return verdict_on(sorted((lagging(*one) for one in each), key=lambda c: c.score))


@pytest.mark.parametrize(
    ("behind", "kind"), [(12.0, VerdictKind.UNDECIDED), (PART_LEAD + 1.0, VerdictKind.EXPLAINED)]
)
@pytest.mark.parametrize("filters", [("torque_low_pass",), ("torque_low_pass", "torque_butterworth")])
def test_a_delay_is_not_taken_for_filters_by_what_a_replay_may_not_resolve(filters, behind, kind):
    found = verdict(([BIAS, *filters], 100.0), ([BIAS, "torque_sensor_delay"], 100.0 + behind))
    assert (found.kind, found.effects) == (kind, (BIAS,))
    if kind is VerdictKind.UNDECIDED:
        assert set(map(frozenset, found.confusable)) == {
            frozenset({BIAS}),
            frozenset({BIAS, "torque_sensor_delay"}),
        }


@pytest.mark.parametrize(
    ("best", "other"),
    [
        (("torque_sensor_delay",), ("torque_low_pass",)),
        (("torque_low_pass",), ("tip_sensor_delay",)),
        (("torque_low_pass",), ("torque_sensor_delay", "stiction")),
        (("torque_low_pass",), ("stiction",)),
    ],
    ids=["a filter for a delay", "of another sensor", "with more", "no delay"],
)
def test_what_is_no_filter_in_place_of_a_delay_is_led_as_any_other(best, other):
    assert not takes_for_a_filter(scored([BIAS, *best], 100.0), scored([BIAS, *other], 112.0))
    found = verdict(([BIAS, *best], 100.0), ([BIAS, *other], 112.0))
    assert found.kind is VerdictKind.EXPLAINED


@pytest.mark.parametrize(
    ("filtered_sigma", "kind"), [(0.9, VerdictKind.EXPLAINED), (1.1, VerdictKind.UNDECIDED)]
)
def test_a_lag_that_does_little_beside_an_effect_is_no_second_cause(filtered_sigma, kind):
    filtered = ([BIAS, "torque_low_pass"], 100.0, filtered_sigma)
    found = verdict(filtered, ([BIAS, "torque_sensor_delay"], 102.0))
    assert (found.kind, found.effects) == (kind, (BIAS,))
    assert {*map(frozenset, found.confusable)} == {
        frozenset({BIAS}),
        frozenset({BIAS, "torque_sensor_delay"}),
    }


def test_means_show_more_of_a_lag_than_a_reading_and_it_is_as_little():
    filtered = lagging([BIAS, "torque_low_pass"], 100.0, 1.9)
    delayed = lagging([BIAS, "torque_sensor_delay"], 102.0)
    assert not lags_little(filtered, delayed)
    assert lags_little(replace(filtered, means_of=4), delayed)


def test_where_the_delay_is_likelier_it_stays_open():
    filtered = lagging([BIAS, "torque_low_pass"], 100.0, 0.5)
    delayed = lagging([BIAS, "torque_sensor_delay"], 98.0)
    assert not lags_little(filtered, delayed)
    assert verdict_on([delayed, filtered]).kind is VerdictKind.UNDECIDED


def test_a_filter_beside_nothing_else_stays_open():
    one = lagging(["torque_low_pass"], 100.0, 0.5)
    other = lagging(["torque_sensor_delay"], 102.0)
    assert not lags_little(one, other)


@pytest.mark.parametrize(
    ("beside", "behind", "gap", "kind"),
    [
        ([], 44.0, 1.01, VerdictKind.UNDECIDED),
        ([], 46.0, 1.01, VerdictKind.NONE),
        ([], 44.0, 1.2, VerdictKind.NONE),
        ([BIAS], 44.0, 1.01, VerdictKind.EXPLAINED),
    ],
    ids=["alone", "led by more", "above the floor", "beside an effect"],
)
def test_nothing_but_a_filter_is_told_where_it_leads_by_more_than_it_takes_of_the_encoders_noise(
    beside, behind, gap, kind
):
    """It would be the one cause that there is; the encoder makes 45."""
    filtered = lagging([*beside, "torque_low_pass"], 100.0)
    delayed = lagging([*beside, "torque_sensor_delay"], 100.0 + behind)
    floor = replace(delayed.floor, gap=gap)
    delayed = replace(delayed, floor=floor, base_noise_cost=45.0)
    found = verdict_on([filtered, delayed])
    assert (found.kind, found.effects) == (kind, tuple(beside))
    if kind is VerdictKind.UNDECIDED:
        assert set(found.confusable) == {(), ("torque_sensor_delay",)}


@pytest.mark.parametrize(
    ("left_sigma", "kind"), [(1.0, VerdictKind.EXPLAINED), (1.05, VerdictKind.UNDECIDED)]
)
def test_a_filter_that_leaves_more_than_noise_leads_a_delay_by_that_at_least(left_sigma, kind):
    """1000 readings at 1.05 sigma leave 102 beyond noise, and a delay is behind by 60."""
    best = lagging([BIAS, "torque_low_pass"], 100.0)
    rows = np.full(1000, left_sigma)
    slopes = np.zeros((1000, best.fit.x.size))
    slopes[:, np.isin(best.fit.parameterization.owners, ["torque_low_pass"])] = 2.0 * STRONG_SIGMA
    best = replace(best, fit=replace(best.fit, by_trial=(rows,), jacobian=(slopes,)))
    late = lagging([BIAS, "torque_sensor_delay"], 160.0)
    assert verdict_on([best, late]).kind is kind


def test_stiffness_and_damping_beside_a_filter_are_in_every_fit():
    best = scored([BIAS, "torque_low_pass", "damping_error"], 100.0)
    assert takes_for_a_filter(best, scored([BIAS, "torque_sensor_delay"], 102.0))
