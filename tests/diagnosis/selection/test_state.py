"""What a search has come to, from stage to stage."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import FITTED_SAMPLES, fit_of, log_of, scored, start_of_search

from diagnosis.fitting.fit import fit_effects
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision, RecordEntry
from diagnosis.selection.state import SearchState

NOTE = RecordEntry(stage="s", effects=(), decision=Decision.KEPT, reason="r")


@pytest.fixture(scope="module")
def start():
    return start_of_search(log_of(NOMINAL, seconds=3.0), effects=("tip_drag",))


def test_candidates_and_the_record_only_grow(start):
    one, other = scored(("tip_drag",), 5.0), scored((), 3.0)
    state = start.adding(([one], (NOTE,))).noting(NOTE).adding(([other], ()))
    assert isinstance(state, SearchState)
    assert state.candidates == (one, other)
    assert state.record == (NOTE, NOTE)
    assert state.best is other
    assert start.candidates == () == start.record


def test_in_units_of_another_noise_residuals_shrink_and_the_needle_is_the_same(start):
    noise = start.problem.noise
    twice = type(noise)(sigma={s: 2.0 * own for s, own in noise.sigma.items()}, white=noise.white)
    again = start.renoised(twice)
    assert again.problem.noise is twice
    for one, other in zip(start.nominal.by_trial, again.nominal.by_trial, strict=True):
        np.testing.assert_allclose(other, one / 2.0)
    rare = {s: again.coarse.noise[s] / start.coarse.noise[s] for s in ("tip_angle_deg",)}
    assert rare["tip_angle_deg"] == pytest.approx(2.0)


@pytest.mark.parametrize("sets", ["singles", "pairs", "triples"])
def test_what_was_fitted_to_the_decimated_log_is_in_units_of_another_noise_too(start, sets):
    fitted = candidate(fit_effects(start.coarse, ("tip_drag",)))
    noise = start.problem.noise
    twice = type(noise)(sigma={s: 2.0 * own for s, own in noise.sigma.items()}, white=noise.white)
    (again,) = getattr(replace(start, **{sets: (fitted,)}).renoised(twice), sets)
    assert again.fit.gap == pytest.approx(0.5 * fitted.fit.gap)


def test_where_the_same_noise_is_coloured_otherwise_fits_are_kept_in_its_units(undisturbed):
    colour = {"tip_angle_deg": NoiseColour.of(share=0.5, correlation_time_s=0.1)}
    noise = replace(undisturbed.problem.noise, colour=colour)
    again = undisturbed.renoised(noise)
    best = undisturbed.best
    left = again.problem.residuals([best.fit.parameterization.rig(best.fit.x)])
    (same,) = (c for c in again.candidates if c.names == best.names)
    np.testing.assert_allclose(same.fit.by_trial[0], left[0][0], atol=1e-9)
    assert len(again.singles) == len(undisturbed.singles)


def test_only_what_was_checked_and_leaves_nothing_beyond_noise_is_at_the_floor(undisturbed):
    assert not replace(undisturbed, checked=None).at_the_floor(undisturbed.best)
    state, explained = undisturbed.rechecked()
    assert explained
    assert state.at_the_floor(state.best)
    assert not state.at_the_floor(scored(("tip_drag",), 1.0))


@pytest.mark.parametrize(("leaves", "near"), [(1.05, 1), (1.2, 2), (0.9, 0)])
def test_about_as_near_are_sets_of_as_many_effects_that_leave_little_more(start, leaves, near):
    def leaving(gap, name):
        return candidate(fit_of((name,), by_trial=[np.full(FITTED_SAMPLES, gap)]))

    singles = (leaving(11.0, "stiction"), leaving(10.0, "tip_drag"))
    state = replace(start, singles=singles, pairs=(leaving(1.0, "tip_drag"),))
    found = state.about_as_near(("tip_drag",), leaves)
    assert [c.names[0] for c in found] == ["tip_drag", "stiction"][:near]
