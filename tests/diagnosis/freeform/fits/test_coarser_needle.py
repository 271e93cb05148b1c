"""The decimated log for a needle half as fine."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, log_of

from diagnosis.fitting.fit import fit_effects
from diagnosis.freeform.fits.coarser_needle import on_coarser_needle
from diagnosis.replay.rig_parameters import RigParameters


@pytest.fixture(scope="module")
def both():
    coarse = coarse_of(log_of(RigParameters(kinetic_n_mm_per_mm=0.001), speed=-1.0))
    base = fit_effects(coarse, ())
    return coarse, base, on_coarser_needle(coarse, base)


def left(problem, rig):
    return np.concatenate([own[0] for own in problem.residuals([rig], callback_alone=True)])


def test_the_rig_without_a_law_leaves_the_same(both):
    coarse, base, rough = both
    rig = base.parameterization.rig(base.x)
    np.testing.assert_allclose(left(rough, rig), left(coarse, rig), atol=1e-6)
    np.testing.assert_allclose(left(rough, rig), np.concatenate(base.by_trial), atol=1e-6)


@pytest.mark.parametrize(
    "law",
    [
        {"kinetic_n_mm_per_mm": 0.001},
        {"kinetic_n_mm_per_mm": 0.003},
        {"tip_drag_n_mm_s_per_rad": 0.1},
        {"backlash_deg": 4.0},
    ],
    ids=str,
)
def test_a_law_changes_it_as_it_changes_the_finer_needle(both, law):
    """Measured 1.4, 0.9, 1.2 and 4.5 %: the limit is twice the largest."""
    coarse, base, rough = both
    rig = base.parameterization.rig(base.x)
    changed = replace(rig, **law)
    fine, coarser = (left(p, changed) - left(p, rig) for p in (coarse, rough))
    assert np.linalg.norm(coarser - fine) < 0.09 * np.linalg.norm(fine)


def test_it_is_half_as_fine_in_all_its_runs(both):
    coarse, _, rough = both
    assert rough.resolution == coarse.resolution.halved
    assert rough.of_differences is rough
    assert rough.samples == coarse.samples
