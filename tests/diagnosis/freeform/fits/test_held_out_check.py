"""The gap on trials that a fit has not seen, over what the other trials leave open of its law."""

from dataclasses import replace

import numpy as np
import pytest
from free_forms import CURVE, family_of, linear_fit, priors, solved

from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.fits.held_out_check import left_open, predictive_gap, share_determined

TRIALS, SAMPLES = 3, 200


def log_of_a_law(rng, reach=1.0, last=0.0):
    """A fit of a law to all trials, and what each leaves when the others predict it.

    Args:
      reach: of coordinates of which the last trial alone tells, in units of the noise.
      last: by which they are others in the last trial.
    """
    family = family_of(name="law")
    truth = rng.normal(size=CURVE.size)
    slopes = [rng.normal(size=(SAMPLES, CURVE.size)) for _ in range(TRIALS)]
    for j in slopes[:-1]:
        j[:, 5:] = 0.0
    slopes[-1][:, 5:] *= reach
    moved = [*[np.zeros(CURVE.size)] * (TRIALS - 1), np.full(CURVE.size, last)]
    each = zip(slopes, moved, strict=True)
    readings = [j @ (truth + own) + rng.normal(size=SAMPLES) for j, own in each]
    fit = linear_fit(family, slopes, readings)
    held_out = []
    for i, (j, y) in enumerate(zip(slopes, readings, strict=True)):
        rest = [k for k in range(TRIALS) if k != i]
        others = solved([slopes[k] for k in rest], [readings[k] for k in rest], priors(family))
        held_out.append(j @ others - y)
    return fit, held_out


def rms(by_trial):
    return float(np.sqrt(np.mean(np.concatenate(by_trial) ** 2)))


def test_a_law_that_holds_has_a_predictive_gap_of_one_where_no_other_trial_has_been():
    """Mean of the squares is 1: the residual is a draw from what the prior leaves open, and noise."""
    rng = np.random.default_rng(1)
    logs = [log_of_a_law(rng, reach=5.0) for _ in range(40)]
    squares = np.array([predictive_gap(*log) ** 2 for log in logs])
    spread = squares.std() / np.sqrt(squares.size)
    assert np.mean(squares) == pytest.approx(1.0, abs=3.5 * spread)
    assert np.mean([rms(held_out) for _, held_out in logs]) > 3.0


def test_of_a_law_that_the_other_trials_determine_it_is_the_gap():
    fit, held_out = log_of_a_law(np.random.default_rng(2), reach=0.0)
    # 5 coordinates of 400 samples: what they leave open is 1 % of the noise.
    assert predictive_gap(fit, held_out) == pytest.approx(rms(held_out), rel=0.02)
    assert predictive_gap(fit, held_out) == pytest.approx(1.0, abs=0.1)


def test_a_law_that_is_another_in_the_last_trial_is_above_one():
    fit, held_out = log_of_a_law(np.random.default_rng(3), reach=0.0, last=3.0)
    assert predictive_gap(fit, held_out) > 1.5


def test_what_the_other_trials_leave_open_is_the_variance_of_the_prior_where_none_of_them_tells():
    fit, _ = log_of_a_law(np.random.default_rng(4), reach=1.0)
    known, unknown = left_open(fit, 0).mean(), left_open(fit, TRIALS - 1).mean()
    slopes, sigma = fit.jacobian[-1][:, 5:], priors(family_of())[5:]
    assert unknown == pytest.approx(np.mean(np.sum((slopes * sigma) ** 2, axis=1)), rel=0.05)
    assert known < 0.05


def test_what_concerns_the_trial_alone_is_not_left_open():
    """Its own coordinates are fitted there; of the others the trial is told as much as without them."""
    fit, _ = log_of_a_law(np.random.default_rng(5), reach=1.0)
    (law,) = fit.parameterization.effects
    own = [replace(p, of_one_trial=i >= 5) for i, p in enumerate(law.parameters)]
    of_trial = replace(fit.parameterization, effects=(replace(law, parameters=tuple(own)),))
    fit = replace(fit, parameterization=of_trial)
    # 5 coordinates of 400 samples leave 5 / 400 of the noise open: a percent, at three times its spread.
    assert left_open(fit, TRIALS - 1).mean() == pytest.approx(5 / 400, rel=0.3)


@pytest.mark.parametrize(("reach", "share"), [(0.0, 1.0), (5.0, 2 / 3)])
def test_the_last_trial_is_not_told_by_others_where_it_alone_reaches(reach, share):
    fit, held_out = log_of_a_law(np.random.default_rng(3), reach=reach)
    one = FreeFit(family=family_of(name="law"), fit=fit, held_out=tuple(held_out))
    assert share_determined(one) == pytest.approx(share, abs=0.01)
    assert share_determined(replace(one, held_out=None)) == 1.0
