"""Hypotheses as vectors."""

import numpy as np
import pytest

from studies.published.experiments.rig import WITH_FREE_LENGTH, WITHOUT_FREE_LENGTH, PublishedRig
from studies.published.fitting.hypothesis import of_gelatin, of_plastisol, stated
from studies.published.fitting.mechanisms import OF_PLASTISOL


@pytest.mark.parametrize("name", OF_PLASTISOL)
def test_every_mechanism_changes_the_rig_from_a_start_within_its_bounds(name):
    hypothesis = of_plastisol(WITH_FREE_LENGTH, name)
    low, high = hypothesis.bounds()
    for start in hypothesis.starts():
        assert np.all((low <= start) & (start <= high))
    assert any(hypothesis.rig(start) != PublishedRig() for start in hypothesis.starts())


def test_the_damping_is_fitted_with_every_mechanism_in_plastisol_but_once():
    assert [m.name for m in of_plastisol(WITH_FREE_LENGTH, "base_ramp").mechanisms] == [
        "damping_error",
        "base_ramp",
    ]
    assert len(of_plastisol(WITH_FREE_LENGTH, "damping_error").mechanisms) == 1
    assert [m.name for m in of_gelatin("torque_bias").mechanisms] == ["torque_bias"]


def test_bounds_are_the_parameters_own_in_the_units_of_the_fit():
    hypothesis = of_plastisol(WITH_FREE_LENGTH, "free_length")
    low, high = hypothesis.bounds()
    # The damping in its logarithm, the length as a share of its range.
    assert low == pytest.approx([np.log(1e-3), 0.0])
    assert high == pytest.approx([np.log(10.0), 1.0])
    assert hypothesis.values(high) == pytest.approx([10.0, 230.0])


def test_nothing_fitted_is_the_stated_rig_itself():
    assert stated(WITHOUT_FREE_LENGTH).rig(np.zeros(0)) == WITHOUT_FREE_LENGTH


def test_the_free_length_is_said_in_words():
    assert stated(WITH_FREE_LENGTH).free_length == "50 mm free"
    assert stated(WITHOUT_FREE_LENGTH).free_length == "no free length"
    assert of_plastisol(WITH_FREE_LENGTH, "free_length").free_length == "free length fitted"
