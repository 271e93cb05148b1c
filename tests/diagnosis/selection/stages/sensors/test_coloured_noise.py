"""All begins again where an effect shows noise of another colour."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import TIP, TORQUE, log_of, start_of_search
from scipy.signal import lfilter

from diagnosis.criteria.noise import (
    COLOUR_ABOVE_HZ,
    COLOUR_CHI_SQUARE,
    COLOUR_WEAK_GAP,
    OTHER_COLOUR_GAP,
)
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.log.trial import Trial
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.stages.sensors import coloured_noise as module
from diagnosis.workers import Workers


def test_a_search_begins_again_where_the_best_effect_leaves_another_colour(dry_start, monkeypatch):
    """Noise that was taken for coloured beside dry friction, and is white once that is known."""
    sigma = dry_start.problem.noise.sigma
    colour = {"tip_angle_deg": NoiseColour.of(share=0.5, correlation_time_s=0.1)}
    noise = replace(dry_start.problem.noise, colour=colour)
    start = replace(
        dry_start,
        effects=("coulomb_friction",),
        nominal=rescaled(dry_start.nominal, dry_start.problem, noise),
        problem=replace(dry_start.problem, noise=noise),
        coarse=replace(dry_start.coarse, noise=replace(dry_start.coarse.noise, colour=colour)),
    )
    monkeypatch.setattr(module, "with_colour", lambda problem, _: replace(problem.noise, colour={}))
    begun = module.single_effects(module.nominal_rig(start, Workers()), Workers())
    again = module.coloured_noise(begun, Workers())
    assert again.problem.noise.colour == again.coarse.noise.colour == {}
    assert again.problem.noise.sigma == sigma
    np.testing.assert_allclose(again.nominal.by_trial[0], dry_start.nominal.by_trial[0], atol=1e-9)
    dropped = [e for e in again.record if e.stage == "coloured noise"]
    assert [e.effects for e in dropped] == [c.names for c in begun.candidates]
    # Where the colours are the same, nothing is done.
    assert module.coloured_noise(again, Workers()) is again


TORQUE_NAME = "base_torque_n_mm"


def weakly_coloured(share):
    """A nominal rig whose tip has noise that is correlated in part, over 50 ms."""
    log = log_of(NOMINAL, seconds=30.0)
    (one,) = log.trials
    rng, size = np.random.default_rng(1), len(one.table)
    kept = np.exp(-0.01 / 0.05)
    slow = lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.normal(size=size))
    more = TIP * np.sqrt(share / (1 - share)) * slow
    table = one.table.assign(tip_angle_deg=one.table["tip_angle_deg"] + more)
    return replace(log, trials=(Trial(name=one.name, table=table),))


def test_a_colour_that_shows_less_is_allowed_for_where_only_that_explains_the_log(monkeypatch):
    """As if the first look had asked for more than any noise shows."""
    log = weakly_coloured(0.25)
    state = module.nominal_rig(start_of_search(log, effects=()), Workers())
    plain = replace(state.problem.noise, colour={}, colour_chi_square=np.inf)
    plain = replace(plain, sigma={**plain.sigma, "tip_angle_deg": TIP})
    state = state.renoised(plain)
    assert not state.rechecked()[1]
    after = module.weakly_coloured_noise(state, Workers())
    assert after.rechecked()[1]
    assert set(after.problem.noise.colour) == {"tip_angle_deg"}
    assert after.problem.noise.colour_chi_square < COLOUR_CHI_SQUARE
    assert module.weakly_coloured_noise(after, Workers()).problem is after.problem  # it is explained


def test_a_weaker_colour_that_leaves_more_than_noise_is_not_fitted():
    """The torque is off by 0.8 sigma besides, which no colour of the tip's noise explains."""
    log = weakly_coloured(0.25)
    (one,) = log.trials
    table = one.table.assign(base_torque_n_mm=one.table["base_torque_n_mm"] + 0.008)
    log = replace(log, trials=(Trial(name=one.name, table=table),))
    state = module.nominal_rig(start_of_search(log, effects=()), Workers())
    plain = replace(state.problem.noise, colour={}, colour_chi_square=np.inf)
    state = state.renoised(replace(plain, sigma={**plain.sigma, "tip_angle_deg": TIP}))
    assert OTHER_COLOUR_GAP < state.best.fit.gap < COLOUR_WEAK_GAP
    after = module.weakly_coloured_noise(state, Workers())
    assert after.problem is state.problem
    assert not any(entry.stage == module.WEAK for entry in after.record)


def test_what_an_effect_leaves_is_no_noise():
    dry = log_of(RigParameters(kinetic_n_mm_per_mm=3e-5), speed=-1.0, seconds=30.0)
    state = module.nominal_rig(start_of_search(dry, effects=()), Workers())
    after = module.weakly_coloured_noise(state, Workers())
    assert not state.best.floor.reached
    assert after.problem.noise.colour == state.problem.noise.colour


def one_over_f(size, rng, begins_hz=np.inf, rate_hz=100.0):
    """Of variance 1, with a density as 1 / f, beside white noise above a frequency."""
    waves = np.fft.rfft(rng.normal(size=size))
    frequency = np.fft.rfftfreq(size, 1.0 / rate_hz)
    waves[0] = 0.0
    waves[1:] *= np.sqrt(1.0 / begins_hz + 1.0 / frequency[1:])
    noise = np.fft.irfft(waves, size)
    return noise / noise.std()


def with_more(rig, seconds=60.0, **noise):
    """The log of a rig, and noise besides, by sensor."""
    log = log_of(rig, seconds=seconds)
    (one,) = log.trials
    table = one.table.assign(**{s: one.table[s] + own(len(one.table)) for s, own in noise.items()})
    return replace(log, trials=(Trial(name=one.name, table=table),))


def of_the_tip(rig):
    """With noise as 1 / f of four times the claim."""
    rng = np.random.default_rng(3)
    return with_more(rig, tip_angle_deg=lambda size: 4.0 * TIP * one_over_f(size, rng))


def of_both(rig, *, alike=False):
    """Both sensors have noise that is as 1 / f below 1 Hz, twice the claim."""
    rng = np.random.default_rng(4)
    tip, torque = (one_over_f(6000, rng, begins_hz=1.0) for _ in range(2))
    torque = 0.7 * torque + 0.7 * tip if alike else torque
    return with_more(
        rig,
        tip_angle_deg=lambda size: 2.0 * TIP * tip[:size],
        base_torque_n_mm=lambda size: 2.0 * TORQUE * torque[:size],
    )


def test_noise_may_go_on_as_one_over_f_where_only_that_explains_the_log():
    """Noise that is forgotten in tenths of a second leaves what is slow of it."""
    state = start_of_search(of_the_tip(NOMINAL), effects=())
    state = module.coloured_noise(module.nominal_rig(state, Workers()), Workers())
    assert set(state.problem.noise.colour) == {"tip_angle_deg"}
    assert not state.rechecked()[1]
    after = module.flicker_noise(state, Workers())
    assert after.problem.noise.colour["tip_angle_deg"].flicker
    assert after.rechecked()[1]
    assert module.flicker_noise(after, Workers()).problem is after.problem  # it is explained


def grown(state, factor):
    """The state with residuals of the best that are so many times as large."""
    floor = state.best.floor.times(factor)
    return replace(state, candidates=(replace(state.best, floor=floor),))


def test_it_is_looked_for_before_more_effects_are_where_the_best_leaves_no_more_than_noise():
    state = start_of_search(of_the_tip(NOMINAL), effects=())
    state = module.coloured_noise(module.nominal_rig(state, Workers()), Workers())
    limit = state.best.floor.gap_limit / state.best.floor.gap
    above = grown(state, 1.01 * limit)
    assert module.flicker_noise_that_shows(above, Workers()) is above
    within = grown(state, 0.99 * limit)
    assert module.flicker_noise_that_shows(within, Workers()).problem.noise.flicker


def test_what_shows_where_effects_do_is_not_looked_for_so_early():
    state = module.nominal_rig(start_of_search(of_both(NOMINAL), effects=()), Workers())
    state = grown(module.coloured_noise(state, Workers()), 0.5)
    assert module.flicker_noise_that_shows(state, Workers()).problem is state.problem


@pytest.mark.parametrize(("gap", "told"), [(1.25, True), (1.35, False)])
def test_where_little_is_left_less_of_one_over_f_is_enough(gap, told, monkeypatch):
    """White noise fits worse by 15; what is left of noise that lasts for seconds is little."""
    state = start_of_search(of_the_tip(NOMINAL), effects=())
    state = module.coloured_noise(module.nominal_rig(state, Workers()), Workers())
    found = module.flicker_left(state.problem, state.best.fit, COLOUR_ABOVE_HZ)
    weak = {sensor: replace(own, gain_cost=15.0) for sensor, own in found.items()}
    monkeypatch.setattr(module, "flicker_left", lambda *_: weak)
    best = state.best
    size = gap / best.fit.gap
    fit = replace(best.fit, by_trial=tuple(size * left for left in best.fit.by_trial))
    assert fit.gap == pytest.approx(gap)
    state = replace(state, candidates=(replace(best, fit=fit),))
    monkeypatch.setattr(module, "_may_explain", lambda *_, **__: True)
    asked = [
        e.reason for e in module.flicker_noise(state, Workers()).record if e.stage == "flicker noise"
    ]
    assert bool(asked) is told


def test_what_an_effect_leaves_is_no_noise_of_one_over_f():
    dry = of_the_tip(RigParameters(kinetic_n_mm_per_mm=6e-4))
    state = module.nominal_rig(start_of_search(dry, effects=()), Workers())
    state = module.coloured_noise(state, Workers())
    assert module.flicker_noise(state, Workers()).problem is state.problem


def test_slow_noise_of_one_over_f_in_both_sensors_explains_a_log():
    state = module.nominal_rig(start_of_search(of_both(NOMINAL), effects=()), Workers())
    state = module.coloured_noise(state, Workers())
    assert not state.rechecked()[1]
    after = module.flicker_noise(state, Workers())
    assert after.rechecked()[1]
    assert set(after.problem.noise.flicker) == {"tip_angle_deg", TORQUE_NAME}


@pytest.mark.parametrize(
    ("names", "explained"), [(("torque_bias",), True), (("torque_bias", "tip_angle_bias"), False)]
)
def test_slow_noise_stands_beside_one_effect_at_most(names, explained):
    state = module.nominal_rig(start_of_search(of_both(NOMINAL), effects=()), Workers())
    state = module.coloured_noise(state, Workers())
    one = candidate(fit_effects(state.problem, names))
    state = replace(state, candidates=(one,))
    after = module.flicker_noise(state, Workers())
    assert after.rechecked()[1] is explained
    assert [c.names for c in after.candidates] == [names]


def test_what_tip_and_torque_have_in_common_is_no_noise():
    state = module.nominal_rig(start_of_search(of_both(NOMINAL, alike=True), effects=()), Workers())
    state = module.coloured_noise(state, Workers())
    assert module.flicker_noise(state, Workers()).problem is state.problem


def test_slow_noise_of_one_sensor_alone_may_be_an_effect():
    rng = np.random.default_rng(4)
    log = with_more(NOMINAL, tip_angle_deg=lambda size: 2.0 * TIP * one_over_f(size, rng, begins_hz=1.0))
    state = module.coloured_noise(
        module.nominal_rig(start_of_search(log, effects=()), Workers()), Workers()
    )
    assert module.flicker_noise(state, Workers()).problem is state.problem


def test_the_best_is_fitted_in_the_noise_that_it_leaves(dry_start):
    """Noise that was taken for coloured takes slow residuals for noise: other values are best in it."""
    noise = dry_start.problem.noise
    colour = {TORQUE_NAME: NoiseColour.of(share=0.9, correlation_time_s=0.3)}
    wrong = dry_start.renoised(replace(noise, colour=colour))
    start = replace(wrong, candidates=(), effects=("coulomb_friction",))
    begun = module.single_effects(module.nominal_rig(start, Workers()), Workers())
    again = module.noise_of_the_best(begun, Workers())
    assert begun.best.names == again.best.names == ("coulomb_friction",)
    assert again.problem.noise.colour == {}
    plain = replace(dry_start, effects=("coulomb_friction",))
    known = module.single_effects(module.nominal_rig(plain, Workers()), Workers())
    here, there = (own.best.fit.parameterization.values(own.best.fit.x)[0] for own in (again, known))
    assert here == pytest.approx(there, rel=1e-3)
    assert module.noise_of_the_best(again, Workers()) is again
