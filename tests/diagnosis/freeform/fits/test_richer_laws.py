"""Which law grows with what, or needs a finer curve: found by its slopes, then fitted."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, log_of

from diagnosis.criteria.freeform import CLOSED_GAP
from diagnosis.fitting.fit import fit_effects
from diagnosis.freeform.families.readings import families
from diagnosis.freeform.family import kind_of
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.freeform.fits.growth_factor import all_grown, grown_over
from diagnosis.freeform.fits.richer_laws import RICHER_OF_ONE, _finer, richer, score_of_richer, start_of
from diagnosis.freeform.ranges import ranges_of
from diagnosis.replay.curve import ActsOn, Course, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.replay.variables import Variable
from diagnosis.workers import Workers

NAME = "tip reading over direction"
END_S = 12.0


@pytest.fixture(scope="module")
def grown():
    """A log whose tip reads 4 deg behind the direction of turning at the end, nothing at the start.

    The coarse problem, its ranges, the fit of that law as if it did not grow, and the gap of the true
    rig: decimation leaves more than noise of a jump.
    """
    of_time = Course(variable=Variable.TIME, places=(0.0, END_S), values=(0.0, 2.0))
    curve = Curve(
        acts_on=ActsOn.TIP_READING,
        variable=Variable.DIRECTION,
        places=(-1.0, 1.0),
        values=(2.0, -2.0),
        factor=of_time,
    )
    true = replace(NOMINAL, free=FreeLaw(curves=(curve,)))
    coarse = coarse_of(log_of(true, seconds=END_S))
    ranges = ranges_of(coarse, replay(coarse.log, resolution=coarse.resolution))
    family = {f.name: f for f in families(ranges)}[NAME]
    fit = fit_effects(with_family(coarse, family), (family.name,))
    left = np.concatenate([own for (own,) in coarse.residuals([true])])
    return coarse, ranges, FreeFit(family=family, fit=fit, gap_after=fit.gap), np.sqrt(np.mean(left**2))


def test_a_law_that_grows_in_time_is_promised_most_and_fitted_to_the_noise(grown):
    coarse, ranges, law, true_gap = grown
    assert law.fit.gap > 2.0 * true_gap
    found = richer(coarse, [law], ranges, Workers(), growing=True)
    assert len(found) == RICHER_OF_ONE
    best = min(found, key=lambda f: f.score)
    assert best.family.name == f"{NAME}, growing with time"
    assert best.fit.gap < 1.02 * true_gap
    own = np.array([owner == best.family.name for owner in best.fit.parameterization.owners])
    values = np.array(best.fit.parameterization.values(best.fit.x))[own]
    time_s, factor = best.family.factor.curve(*values)
    _, size = best.family.curve(*values)
    at = dict(zip(("forwards", "backwards"), np.interp([4.0, END_S], time_s, factor), strict=True))
    assert size[1] * at["forwards"] == pytest.approx(-2.0 * 2.0 * 4.0 / END_S, abs=0.3)
    assert size[0] * at["backwards"] == pytest.approx(2.0 * 2.0, abs=0.3)


def test_growing_promises_more_than_the_law_leaves_alone(grown):
    coarse, ranges, law, _ = grown
    promised = {f.name: score_of_richer(coarse, law, f) for f in all_grown(law.family, ranges)}
    assert min(promised, key=promised.get) == f"{NAME}, growing with time"
    assert min(promised.values()) < law.score


def test_a_fit_starts_from_the_law_that_does_not_grow(grown):
    coarse, ranges, law, _ = grown
    family = all_grown(law.family, ranges)[0]
    start = start_of(coarse, law, family)
    parts = with_family(coarse, family).parameterization((family.name,)).parts(start)
    size = len(law.family.effect.parameters)
    np.testing.assert_array_equal(parts[family.name][:size], law.fit.parts[law.family.name])
    assert not parts[family.name][size:].any()


def test_what_may_not_grow_is_left_out(grown):
    coarse, ranges, law, _ = grown
    again = grown_over(law.family, Variable.TIME, 0.0, END_S)
    fit = fit_effects(with_family(coarse, again), (again.name,), start_of(coarse, law, again))
    twice = FreeFit(family=again, fit=fit, gap_after=fit.gap)
    assert richer(coarse, [twice], ranges, Workers(), growing=True) == []


def with_a_bump(width_deg):
    """A coarse problem whose tip reads up to 4 deg more about one angle, its ranges, and the fit of an
    error over the angle."""
    at = np.linspace(-200.0, 200.0, 401)
    bump = Curve(
        acts_on=ActsOn.TIP_READING,
        variable=Variable.TIP_ANGLE,
        places=tuple(at),
        values=tuple(4.0 * np.exp(-(((at - 20.0) / width_deg) ** 2) / 2.0)),
    )
    coarse = coarse_of(log_of(replace(NOMINAL, free=FreeLaw(curves=(bump,))), seconds=END_S))
    ranges = ranges_of(coarse, replay(coarse.log, resolution=coarse.resolution))
    family = {f.name: f for f in families(ranges)}["tip reading over tip_angle"]
    fit = fit_effects(with_family(coarse, family), (family.name,))
    return coarse, ranges, FreeFit(family=family, fit=fit, gap_after=fit.gap)


def test_a_narrow_bump_takes_a_finer_curve():
    coarse, ranges, law = with_a_bump(width_deg=9.0)
    (found,) = richer(coarse, [law], ranges, Workers(), growing=False)
    assert found.family.name == law.family.name
    assert found.fit.gap < CLOSED_GAP < 0.9 * law.fit.gap
    assert found.score < law.score


def test_a_finer_curve_begins_with_the_priors_of_its_law():
    _, ranges, law = with_a_bump(width_deg=9.0)
    known = replace(law, family=law.family.with_prior({"straight": 0.3, "rest": 4.0}))
    finer = {family.name: family for family in families(ranges.in_more_detail)}
    (family,) = _finer(known, finer)
    sigma = {kind_of(p): p.prior_sigma for p in family.effect.parameters}
    assert sigma == {"straight": 0.3, "rest": 4.0, "detail": 1.0}


def test_a_wide_bump_does_not():
    coarse, ranges, law = with_a_bump(width_deg=40.0)
    assert law.fit.gap < CLOSED_GAP
    assert richer(coarse, [law], ranges, Workers(), growing=False) == []


def test_a_narrower_one_takes_one_that_is_finer_still():
    coarse, ranges, law = with_a_bump(width_deg=6.0)
    (finer,) = richer(coarse, [law], ranges, Workers(), growing=False)
    (found,) = richer(coarse, [finer], ranges.in_more_detail, Workers(), growing=False)
    assert found.fit.gap < 0.9 * finer.fit.gap
    assert found.score < finer.score
