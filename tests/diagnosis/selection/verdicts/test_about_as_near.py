"""What comes about as near to an unknown log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import FITTED_SAMPLES, fit_of, log_of, start_of_search, verdict_of

from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdicts.about_as_near import with_what_is_as_near
from diagnosis.selection.verdicts.verdict import VerdictKind


def left(gap, *names):
    """A set of effects with what it leaves on the decimated log."""
    return candidate(fit_of(names, by_trial=[np.full(FITTED_SAMPLES, gap)]))


@pytest.fixture(scope="module")
def start():
    return start_of_search(log_of(NOMINAL, seconds=3.0), effects=("tip_drag",))


@pytest.fixture
def found(start):
    """A search of a log whose needle never slides, and which nothing explains."""
    singles = (
        left(20.0, "stiction"),
        left(21.0, "tip_drag"),
        left(21.5, "speed_dependent_friction"),
        left(21.6, "coulomb_friction"),
        left(23.0, "shear_thinning"),
    )
    pairs = (
        left(10.0, "stiction", "torque_clock"),
        left(10.5, "stiction", "torque_clock", "tip_drag"),
        left(10.9, "sheath_friction", "torque_bias"),
        left(11.1, "tip_drag", "torque_bias"),
    )
    return replace(start, singles=singles, pairs=pairs)


def told(found, *names, kind=VerdictKind.UNKNOWN):
    verdict = replace(verdict_of((["tip_drag"], 1.0)), kind=kind, best=left(30.0, *names))
    return with_what_is_as_near(verdict, found).as_near


def test_sets_within_a_tenth_are_told_nearest_first_with_friction_by_its_plain_name(found):
    assert told(found, "stiction") == (("tip_drag",), ("coulomb_friction",))


def test_beside_an_imperfection_of_a_sensor_single_effects_count_too(found):
    near = (("sheath_friction", "torque_bias"), ("tip_drag",), ("coulomb_friction",))
    assert told(found, "stiction", "torque_clock") == near


def test_a_verdict_that_names_effects_has_no_others_as_near(found):
    assert told(found, "stiction", kind=VerdictKind.EXPLAINED) == ()


def test_where_the_best_was_not_fitted_when_decimated_nothing_is_compared(found):
    assert told(found, "torque_bias") == ()
