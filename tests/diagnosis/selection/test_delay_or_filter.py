"""A delay of a sensor, or filters in its place."""

import pytest
from diagnosis_fixtures import scored

from diagnosis.criteria import PART_LEAD
from diagnosis.selection.delay_or_filter import takes_for_a_filter
from diagnosis.selection.verdict import VerdictKind, verdict_on


def verdict(*each):
    """On candidates at the noise floor, by names and score."""
    return verdict_on(sorted((scored(*one) for one in each), key=lambda c: c.score))


BIAS = "tip_angle_bias"


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
