"""What the drift of a working sensor may be."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, scored
from drifting_logs import SIZES, drifted, moved, off, searched

from diagnosis.criteria import DRIFT_ALIKE_SIGMA, DRIFT_RANGE_SIGMA
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.prepare.noise.sensor_noise import TIP, TORQUE
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.stages.sensors.working_sensor import (
    allowed_sigma,
    begins_off_zero,
    drifts,
    range_sigma,
    what_it_follows,
    with_few_effects,
)


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_drift_is_one_of_its_sensor_and_has_the_range_of_its_line(sensor):
    """In sigma, of which a size is 1.5; the other sensor has none."""
    _, after = searched(drifted(2.5, sensor), sensor)
    (other,) = {*SENSORS} - {sensor}
    assert (drifts(after, sensor), drifts(after, other)) == (True, False)
    assert range_sigma(after, sensor) == pytest.approx(1.5 * 2.5, abs=1.0)
    assert range_sigma(after, other) == 0.0


@pytest.mark.parametrize("sensor", SENSORS)
def test_of_one_line_in_every_trial_less_is_allowed(sensor):
    _, apart = searched(moved((0, 0, 4), (0, 0, -4), sensor=sensor), sensor)
    _, alike = searched(moved((0, 0, 4), (0, 0, 4), sensor=sensor), sensor)
    assert allowed_sigma(apart, sensor) == DRIFT_RANGE_SIGMA
    assert allowed_sigma(alike, sensor) == DRIFT_ALIKE_SIGMA


@pytest.mark.parametrize("sensor", SENSORS)
def test_where_every_trial_begins_off_zero_is_told(sensor):
    _, zeroed = searched(moved((0, 0, 4), (3, 0, 3), sensor=sensor), sensor)
    _, raised = searched(moved((3, 0, 3), (4, 0, 3), sensor=sensor), sensor)
    assert (begins_off_zero(zeroed, sensor), begins_off_zero(raised, sensor)) == (False, True)


def test_effects_that_do_not_count_stand_beside_a_drift_as_well():
    state = searched(drifted(0.0))[1]
    sets = (("tip_drag",), ("tip_drag", "tip_angle_bias"), ("tip_drag", "stiction"))
    state = replace(state, candidates=tuple(scored(names, 1.0) for names in sets))
    assert [c.names for c in with_few_effects(state).candidates] == [*sets[:1]]
    assert [c.names for c in with_few_effects(state, ["tip_angle_bias"]).candidates] == [*sets[:2]]


def plunged():
    """A needle that is pushed in and drawn back while its base turns."""
    log = log_of(NOMINAL, seconds=14.0)
    (one,) = log.trials
    depth = 90.0 + 5.0 * np.sin(1.5 * one.table["time_s"])
    return replace(log, trials=(Trial(name=one.name, table=one.table.assign(inserted_mm=depth)),))
