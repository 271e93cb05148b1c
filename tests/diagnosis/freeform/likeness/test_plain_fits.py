"""Plain laws are fitted in place of curves, where they leave as little."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from free_forms import CURVE, family_of, free_fit, linear_fit, one_trial
from rig_outside import log_outside

from diagnosis.fitting.decimation import decimated
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.law_curve import law_of
from diagnosis.freeform.likeness import plain_fits
from diagnosis.freeform.likeness.plain_fits import with_plain_laws
from diagnosis.freeform.search import free_form_fits
from diagnosis.nominal_replay import replay_nominal
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

SAMPLES, TRIALS, NOISE_SEED = 300, 3, 3


def curve_fit_of(truth):
    """A curve over x that was fitted to readings of a law, which goes furthest in the last trial."""
    rng = np.random.default_rng(NOISE_SEED)
    family = family_of(name="law")
    along = [rng.uniform(0.0, 0.6 if i else 1.0, SAMPLES) for i in range(TRIALS)][::-1]
    slopes = [
        np.array([np.interp(x, CURVE.places, column) for column in CURVE.basis.T]).T for x in along
    ]
    readings = [j @ np.array(CURVE.coordinates(truth(CURVE.places))) for j in slopes]
    scale = 20.0
    slopes = [scale * j for j in slopes]
    readings = [scale * r + rng.normal(size=SAMPLES) for r in readings]
    fit = linear_fit(family, slopes, readings)
    held_out = tuple(np.full(SAMPLES, 5.0 if i == TRIALS - 1 else 1.0) for i in range(TRIALS))
    return FreeFit(family=family, fit=fit, held_out=held_out, gap_after=5.0, final=True)


@pytest.fixture
def refitted(monkeypatch):
    """Plain fits that leave so many times the gap of the curve: `refitted.times`."""
    given = SimpleNamespace(times=1.0, shapes=[])

    def near(_, curve, family):
        given.shapes.append(family.shape)
        x = np.array([p.to_fit(p.start[0]) for p in family.effect.parameters])
        return fitted(_, replace(curve, family=family), x)

    def fitted(_, contender, x):
        rows = [np.eye(SAMPLES, x.size)] * TRIALS
        left = [np.full(SAMPLES, given.times * contender.fit.gap)] * TRIALS
        readings = [j @ x - r for j, r in zip(rows, left, strict=True)]
        fit = linear_fit(contender.family, rows, readings, x=x)
        return replace(contender, fit=fit, held_out=tuple(left), gap_after=1.0, final=True)

    problem, _ = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    monkeypatch.setattr(plain_fits, "fitted_near", near)
    monkeypatch.setattr(plain_fits, "fitted_and_checked", fitted)
    given.of = lambda *fits: with_plain_laws(problem, problem, fits, Workers())
    return given


def line(x):
    return 1.0 + 2.0 * x


def test_a_law_that_leaves_as_little_takes_the_place_of_the_curve(refitted):
    curve = curve_fit_of(line)
    (first,) = refitted.of(curve)
    assert first.family.shape == law_of(first).shape != ""
    assert "straight line" in refitted.shapes


def test_beside_one_that_predicts_less_well_the_curve_stays(refitted):
    curve = replace(curve_fit_of(line), gap_after=0.9)
    first, second = refitted.of(curve)
    assert first.family.shape
    assert second is curve


def test_one_that_leaves_more_is_dropped(refitted):
    refitted.times = 1.2
    curve = curve_fit_of(line)
    assert refitted.of(curve) == (curve,)


def test_what_is_level_does_not_depend_on_the_variable(refitted):
    curve = curve_fit_of(lambda x: 2.0 + 0 * x)
    assert refitted.of(curve) == (curve,)
    assert "constant" in refitted.shapes


def test_a_curve_that_resembles_nothing_stays_alone(refitted):
    curve = curve_fit_of(lambda x: 3.0 * np.sin(9.0 * x**2))
    assert refitted.of(curve) == (curve,)
    assert refitted.shapes == []


def test_what_is_made_of_three_laws_is_no_plain_law(refitted):
    curve = curve_fit_of(line)
    three = replace(curve, others=(curve.family, curve.family))
    assert refitted.of(three) == (three,)
    assert refitted.shapes == []


def test_only_fits_to_the_log_itself_are_looked_at(refitted):
    curve = replace(curve_fit_of(line), final=False)
    assert refitted.of(curve) == (curve,)
    assert refitted.of(free_fit(1.0))[0].gap_after == 1.0


def test_a_law_that_cannot_be_simulated_is_dropped(refitted, monkeypatch):
    def failing(*_):
        raise SimulationFailed("the simulation lost its numbers")

    monkeypatch.setattr(plain_fits, "fitted_and_checked", failing)
    curve = curve_fit_of(line)
    assert refitted.of(curve) == (curve,)


def test_a_trial_that_the_others_do_not_determine_is_told_by_the_curve(refitted):
    """Of the last trial alone the readings depend on the law: the curve's prior knows that."""
    curve = curve_fit_of(line)
    (first,) = refitted.of(curve)
    assert (first.held_out[-1] < 2.0).all()
    left_open = {0: 0.1, 1: 0.1, 2: 1e6}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plain_fits, "left_open", lambda _, i: np.full(SAMPLES, left_open[i]))
        (first,) = refitted.of(curve)
    np.testing.assert_array_equal(first.held_out[-1], curve.held_out[-1])
    np.testing.assert_array_equal(first.held_out[0], first.held_out[1])


@pytest.mark.slow
def test_cogging_of_the_drive_is_fitted_as_the_wave_that_it_is():
    """Of the independent rig: 0.06 N mm, 16 teeth."""
    ripple = {"amplitude": 0.06, "teeth": 16.0, "phase": 30.0}
    nominal = replay_nominal(log_outside({"torque_ripple": ripple}))
    coarse = decimated(nominal.problem, nominal.predictions)
    curves = free_form_fits(nominal.problem, coarse, (), Workers())
    best, *_ = with_plain_laws(nominal.problem, coarse, curves, Workers())
    assert best.family.shape == "sine wave"
    _, amplitude, *_ = best.fit.parameterization.values(best.fit.x)
    spread = np.sqrt(np.diag(np.linalg.inv(best.fit.slopes.T @ best.fit.slopes)))
    error = spread[1] * best.family.effect.parameters[1].scale
    assert abs(abs(amplitude) - 0.06) < 4 * error < 0.01
    assert best.gap_after < 1.1
