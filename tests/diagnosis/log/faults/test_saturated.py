"""Samples at an end of the range of a sensor are set aside."""

import numpy as np
import pandas as pd
from analytic_log import TURNS

from diagnosis.criteria.faults import SATURATED_LEAST_RUN
from diagnosis.log.faults.saturated import ends_of_ranges
from diagnosis.log.faults.sensor_faults import without_faults
from diagnosis.log.trial import Trial


def test_few_saturated_samples_are_set_aside_where_another_trial_shows_the_end_of_the_range():
    noise = {"base_angle_deg": 0.0, "tip_angle_deg": 0.3}
    many, few = (
        Trial(name=f"{limit}.csv", table=TURNS.assign(tip_angle_deg=turned.clip(-60.0, 60.0)))
        for limit, turned in (("many", TURNS["tip_angle_deg"]), ("few", _peaking(61.0)))
    )
    ends = ends_of_ranges([many, few], noise)
    assert ends["tip_angle_deg"] == {60.0, -60.0}
    at_the_end = few["tip_angle_deg"] == 60.0
    assert 0 < at_the_end.sum() < SATURATED_LEAST_RUN
    alone, told = (without_faults(few, noise, own)[0]["tip_angle_deg"] for own in ({}, ends))
    assert np.isfinite(alone[at_the_end]).all()
    assert np.isnan(told[at_the_end]).all()
    assert np.isfinite(told).sum() > 0.9 * told.size


def _peaking(most):
    """A slow wave that scatters, and peaks at a value once."""
    phase = np.linspace(0.0, 2.0 * np.pi, len(TURNS))
    noise = np.random.default_rng(8).normal(0.0, 0.3, len(TURNS))
    return pd.Series(20.0 + (most - 20.0) * np.sin(phase) ** 31 + noise)
