"""What a fit leaves beyond noise."""

import numpy as np
import pytest
from diagnosis_fixtures import fit_of

from diagnosis.criteria.faults import FAULT_LEAST_SHARE
from diagnosis.selection.scoring.beyond_noise import cost_beyond_noise

SAMPLES = 1000


@pytest.mark.parametrize(
    ("gap", "beyond"), [(2.0, 3.0), (1.1, 0.21), (1.001, FAULT_LEAST_SHARE), (0.9, FAULT_LEAST_SHARE)]
)
def test_it_is_the_cost_above_that_of_noise_and_a_little_at_least(gap, beyond):
    fit = fit_of(("tip_drag",), by_trial=[np.full(SAMPLES, gap)])
    assert cost_beyond_noise(fit) == pytest.approx(beyond * SAMPLES)
