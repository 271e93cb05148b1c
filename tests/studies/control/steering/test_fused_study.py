"""Base alone against base and images: where the base is wrong, and where it is right."""

import numpy as np
import pytest

from studies.control.steering.fused_study import (
    ESTIMATORS,
    PLANTS,
    compare_estimators,
    insert,
    wandering_path,
)

ALONE, DOUBTING, AVERAGED = ESTIMATORS
BY_NAME = {plant.name: plant for plant in PLANTS}


@pytest.fixture(scope="module")
def errors():
    names = ("as assumed", "torque sensor off by 0.5 N mm")
    return compare_estimators([BY_NAME[name] for name in names], seeds=(1, 2, 3))


@pytest.mark.slow
def test_where_the_torque_sensor_is_off_images_pull_the_roll_back(errors):
    wrong = errors["torque sensor off by 0.5 N mm"]
    assert wrong[ALONE].end_deg.median > 8.0
    assert wrong[AVERAGED].end_deg.median < 0.3 * wrong[ALONE].end_deg.median
    assert wrong[AVERAGED].rms_deg.median < 0.5 * wrong[ALONE].rms_deg.median


@pytest.mark.slow
def test_where_the_base_is_right_the_average_is_not_worse_and_doubt_alone_is(errors):
    """Negative control: the noise of the images must not come into the roll."""
    right = errors["as assumed"]
    assert right[AVERAGED].rms_deg.median < right[ALONE].rms_deg.median + 0.1
    assert right[DOUBTING].rms_deg.median > right[ALONE].rms_deg.median + 0.5


def test_the_tip_torque_twists_the_needle_by_its_length():
    run = insert(BY_NAME["1.5 N mm at the tip"])
    lag = run.base_deg[-1] - run.tip_deg[-1]
    # Held against it from the base: 1.5 N mm over 150 mm of shaft, 39.8 deg.
    assert lag == pytest.approx(np.degrees(1.5 * 150 / run.setup.needle.rigidity_n_mm2), rel=0.05)


def test_every_seed_wanders_its_own_way_and_little():
    run = insert(BY_NAME["as assumed"])
    first, second = wandering_path(run, 1), wandering_path(run, 2)
    assert np.array_equal(first, wandering_path(run, 1))
    apart = np.linalg.norm(first[-1] - second[-1])
    # 0.05 deg / sqrt(mm) over 80 mm: s^1.5 / sqrt(3) of it, 0.36 mm an axis and needle.
    assert 0.01 < apart < 4 * 0.36 * np.sqrt(4)
