"""Which law is worth a fit beside another: by a linear model, and from no simulation."""

from dataclasses import replace

import numpy as np
import pytest
from free_forms import CURVE, family_of, linear_fit

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.parameterization import Parameterization
from diagnosis.freeform.fits import laws_beside as module
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.fits.laws_beside import laws_beside
from diagnosis.replay.free_law import FreeLaw

SAMPLES = 400
NAMES = ("a", "b", "c", "d")


@pytest.fixture
def linear():
    """Readings that are the sum of two laws of four, and the fits of all four alone."""
    rng = np.random.default_rng(3)
    slopes = {name: rng.normal(size=(SAMPLES, CURVE.size)) for name in NAMES}
    readings = slopes["a"] @ rng.normal(size=CURVE.size)
    readings += 0.5 * slopes["c"] @ rng.normal(size=CURVE.size)
    readings += 0.1 * rng.normal(size=SAMPLES)
    return slopes, readings


def fits_of(slopes, readings, apply=lambda rig, *_: rig):
    families = [family_of(name=name) for name in slopes]
    families = [replace(f, effect=replace(f.effect, apply=apply)) for f in families]
    return [
        FreeFit(family=family, fit=linear_fit(family, [own], [readings]))
        for family, own in zip(families, slopes.values(), strict=True)
    ]


def base_of(readings):
    return Fit(
        names=(),
        parameterization=Parameterization(effects=(), nuisance=()),
        x=np.zeros(0),
        by_trial=(-readings,),
        jacobian=(np.zeros((readings.size, 0)),),
        cost=float(readings @ readings),
        status=None,
    )


def test_the_law_that_is_missing_beside_the_best_promises_most(linear):
    slopes, readings = linear
    laws = sorted(fits_of(slopes, readings), key=lambda f: f.fit.cost)
    assert laws[0].family.name == "a"
    found = laws_beside(base_of(readings), laws, laws)
    assert found[0].names == ("a", "c")
    assert found[0].fit is laws[0].fit


def test_the_promise_is_what_a_common_fit_leaves(linear):
    """Least squares of both together, with the priors of both, is the oracle."""
    slopes, readings = linear
    first, _, second, _ = fits_of(slopes, readings)
    (promised,) = module._predicted_scores(first.fit, [module._other(base_of(readings), second)])
    change = second.fit.by_trial[0] + readings  # by its first fit
    other = np.vstack([np.column_stack([slopes["c"], change]), np.zeros((CURVE.size, CURVE.size + 1))])
    law = np.vstack([slopes["a"], np.eye(CURVE.size)])
    both, wanted = np.column_stack([law, other]), np.append(readings, np.zeros(CURVE.size))
    prior = np.column_stack([np.zeros((CURVE.size + 1, CURVE.size)), np.eye(CURVE.size + 1)])
    _, cost = _least_squares(np.vstack([both, prior]), np.append(wanted, np.zeros(CURVE.size + 1)))
    beyond = np.column_stack([own - law @ _least_squares(law, own)[0] for own in other.T])
    squares = beyond.T @ beyond
    freedom = np.trace(np.linalg.solve(squares + np.eye(CURVE.size + 1), squares))
    expected = SAMPLES * np.log(cost / SAMPLES) + freedom * np.log(SAMPLES)
    assert promised == pytest.approx(expected, rel=1e-6)


def _least_squares(system, wanted):
    found, *_ = np.linalg.lstsq(system, wanted, rcond=None)
    return found, float(np.sum((system @ found - wanted) ** 2))


def test_of_two_laws_the_one_that_leaves_less_alone_leads(linear):
    slopes, readings = linear
    laws = sorted(fits_of(slopes, readings), key=lambda f: f.fit.cost)
    order = [law.family.name for law in laws]
    for pair in laws_beside(base_of(readings), laws, laws[::-1]):
        one, other = pair.names
        assert order.index(one) < order.index(other)


def test_few_pairs_are_kept_and_few_of_one_law(linear):
    slopes, readings = linear
    rng = np.random.default_rng(4)
    many = {**slopes, **{f"more {i}": rng.normal(size=(SAMPLES, CURVE.size)) for i in range(8)}}
    laws = sorted(fits_of(many, readings), key=lambda f: f.fit.cost)
    found = laws_beside(base_of(readings), laws, laws)
    assert len(found) == module.PAIRS
    firsts = [pair.names[0] for pair in found]
    assert max(firsts.count(name) for name in firsts) <= module.PAIRS_OF_ONE
    assert len({frozenset(pair.names) for pair in found}) == len(found)


def test_a_third_law_is_none_of_the_two(linear):
    slopes, readings = linear
    one, other, *more = fits_of(slopes, readings)
    pair = replace(one, others=(other.family,))
    found = laws_beside(base_of(readings), [pair], [one, other, *more])
    assert {found_one.names[:2] for found_one in found} == {("a", "b")}
    assert {found_one.names[2] for found_one in found} == {"c", "d"}


def test_laws_that_set_the_same_part_of_a_rig_are_no_pair(linear):
    slopes, readings = linear
    sided = iter((0.1, 0.2, 0.3, 0.4) * 50)
    laws = fits_of(slopes, readings, lambda rig, *_: replace(rig, free=FreeLaw(asymmetry=next(sided))))
    assert laws_beside(base_of(readings), laws, laws) == []
