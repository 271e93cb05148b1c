"""Stages in words, and what they usually take."""

import pytest

from diagnosis.selection.search import STAGES as SEARCHED
from diagnosis.selection.stages import mesh_refinement
from diagnosis.selection.stages.sensors import (
    drift_or_offset,
    outliers_left,
    reading_jumps,
    sensor_drift,
)
from diagnosis.stages import STAGES, in_words, usual


def test_a_stage_that_is_not_known_is_told_as_it_is_and_takes_no_time():
    assert in_words("another stage") == "another stage"
    assert usual("another stage").task_s == 0.0


@pytest.mark.parametrize("module", [mesh_refinement, outliers_left, reading_jumps, drift_or_offset])
def test_names_are_those_of_the_search(module):
    assert module.STAGE in STAGES


@pytest.mark.parametrize("name", [sensor_drift.OF_TORQUE, sensor_drift.OF_TIP])
def test_names_of_drifts_are_too(name):
    assert name in STAGES


@pytest.mark.parametrize("name", sorted({stage.__name__.replace("_", " ") for stage in SEARCHED}))
def test_what_a_stop_leaves_out_of_the_search_is_told_in_words(name):
    assert in_words(name) != name


def test_words_are_no_names_and_nothing_takes_less_where_nothing_explains_the_log():
    for name, stage in STAGES.items():
        assert stage.words.split()[0].endswith("ing"), name
        assert 0 <= stage.least <= stage.most, name
