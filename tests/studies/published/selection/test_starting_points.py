"""Where fits start."""

from dataclasses import replace

import numpy as np
import pytest
from reference_fits import fit_with

from studies.published.experiments.rig import WITH_FREE_LENGTH
from studies.published.fitting.hypothesis import of_plastisol
from studies.published.selection.starting_points import starts_of_pair, starts_of_single


def fitted(name, x, z):
    return replace(fit_with((name,), z), x=np.array(x))


def test_a_single_mechanism_starts_at_its_own_starts_and_at_the_damping_fitted_alone():
    single = of_plastisol(WITH_FREE_LENGTH, "base_servo")
    own = single.starts()
    assert np.array_equal(starts_of_single(single, None), own)
    starts = starts_of_single(single, fitted("damping_error", [-0.7], 3.0))
    assert len(starts) == 2 * len(own)
    assert starts[-1] == pytest.approx([-0.7, own[-1][1]])


def test_a_pair_starts_at_the_better_single_fit_whichever_place_it_has():
    pair = of_plastisol(WITH_FREE_LENGTH, "base_ramp", "base_servo")
    ramp, servo = fitted("base_ramp", [0.1, 0.2], 3.0), fitted("base_servo", [0.3, 0.4], 2.0)
    # The better fit's damping is taken with it.
    first = starts_of_pair(pair, {"base_ramp": ramp, "base_servo": servo})[0]
    assert first == pytest.approx([0.3, 0.2, 0.4])
    better_ramp = fitted("base_ramp", [0.1, 0.2], 1.0)
    first = starts_of_pair(pair, {"base_ramp": better_ramp, "base_servo": servo})[0]
    assert first == pytest.approx([0.1, 0.2, 0.4])


def test_a_mechanism_that_was_not_fitted_alone_joins_with_its_own_starts():
    pair = of_plastisol(WITH_FREE_LENGTH, "base_ramp", "base_servo")
    starts = starts_of_pair(pair, {"base_ramp": fitted("base_ramp", [0.1, 0.2], 3.0)})
    own = of_plastisol(WITH_FREE_LENGTH, "base_servo").starts()
    assert [s[2] for s in starts] == pytest.approx([x[1] for x in own])
