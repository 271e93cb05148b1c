"""The noise that a law leaves, where something else had passed for noise."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, log_of, problem_of
from free_forms import free_fit

from diagnosis.criteria.freeform import CLOSED_GAP
from diagnosis.fitting.decimation import decimated
from diagnosis.freeform.fits.noise_left import in_noise, noise_left, rescaled_fits
from diagnosis.log.trial import SENSORS, TORQUE
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL

WHITE = problem_of(log_of(NOMINAL, seconds=14.0), sigma=NOISE.sigma)
SLOW = NoiseColour.of(share=0.6, correlation_time_s=0.3)
LARGER = replace(
    NOISE,
    sigma=NOISE.sigma | {s: 1.6 * NOISE.sigma[s] for s in SENSORS},
    colour=dict.fromkeys(SENSORS, SLOW),
    white={s: NOISE.sigma[s] for s in SENSORS},
)


def fit_in(problem, *, gap=None, final=True):
    """A law that leaves what the nominal rig does; its cost tells a gap."""
    by_trial = tuple(own[0] for own in problem.residuals([NOMINAL]))
    samples = sum(own.size for own in by_trial)
    cost = sum(float(own @ own) for own in by_trial) if gap is None else samples * gap**2
    made = free_fit(1.0, final=final)
    jacobian = tuple(np.zeros((own.size, 1)) for own in by_trial)
    return replace(made, fit=replace(made.fit, by_trial=by_trial, jacobian=jacobian, cost=cost))


def test_white_noise_is_found_where_a_larger_coloured_one_was_taken_for_it():
    """To the scatter of an estimate from first differences of 1400 residuals: 3 %, three times."""
    problem = replace(WHITE, noise=LARGER)
    found = noise_left(problem, [fit_in(problem)])
    assert not found.colour
    for sensor in SENSORS:
        assert found[sensor] == pytest.approx(NOISE[sensor], rel=0.09)


def test_noise_that_is_coloured_stays():
    """Drawn as it was taken for: white noise, and an autoregression."""
    problem, rng = replace(WHITE, noise=LARGER), np.random.default_rng(3)
    (one,), (exact,) = problem.log.trials, replay(problem.log)
    readings = {s: exact[s] + LARGER[s] * drawn(one.time_s, rng) for s in SENSORS}
    coloured = replace(problem, log=replace(problem.log, trials=(replace(one, readings=readings),)))
    assert noise_left(coloured, [fit_in(coloured)]) is None


def drawn(time_s, rng):
    """Noise of unit variance with the share and the correlation time of `SLOW`."""
    kept = np.exp(-(time_s[1] - time_s[0]) / 0.3)
    slow = np.sqrt(0.6) * rng.normal(size=time_s.size)
    for i in range(1, slow.size):
        slow[i] = kept * slow[i - 1] + np.sqrt(1.0 - kept**2) * slow[i]
    return slow + np.sqrt(0.4) * rng.normal(size=time_s.size)


@pytest.mark.parametrize(
    "fits",
    [
        [],
        [fit_in(WHITE, gap=CLOSED_GAP + 0.01)],
        [fit_in(WHITE, final=False)],
    ],
)
def test_only_a_law_that_closes_the_gap_of_the_log_tells_the_noise(fits):
    assert noise_left(replace(WHITE, noise=LARGER), fits) is None


def test_white_noise_is_not_asked_for():
    assert noise_left(WHITE, [fit_in(WHITE)]) is None


def test_the_decimated_log_has_the_noise_of_its_means():
    nominal = replay_nominal(log_of(NOMINAL, seconds=14.0))
    coarse = decimated(nominal.problem, nominal.predictions)
    half = replace(
        nominal.problem.noise, sigma={s: 0.5 * v for s, v in nominal.problem.noise.sigma.items()}
    )
    fine, rare = in_noise(nominal.problem, coarse, half)
    assert fine.noise is half
    for sensor in SENSORS:
        assert rare.noise[sensor] == pytest.approx(0.5 * coarse.noise[sensor])


def test_fits_in_less_noise_leave_more_of_it():
    half = replace(NOISE, sigma=NOISE.sigma | {TORQUE: 0.5 * NOISE.sigma[TORQUE]})
    one = fit_in(WHITE, final=False)
    (found,) = rescaled_fits([one], WHITE, half)
    assert 1.3 < found.gap_after / one.fit.gap < 1.9  # sqrt((1 + 4) / 2) where both leave as much
    assert found.gap_after == pytest.approx(found.fit.gap)
