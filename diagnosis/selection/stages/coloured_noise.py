"""The colour of the noise, once an effect is known.

Where that is another, effects are fitted once more, from where they are.
"""

from dataclasses import replace

from diagnosis.fitting.noise_reestimation import with_colour
from diagnosis.selection.record import dropped
from diagnosis.selection.stages.nominal_rig import nominal_rig, stiffness_or_damping_alone
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.selection.stages.stage import run_stages, stopped_in
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers


def coloured_noise(state: SearchState, workers: Workers) -> SearchState:
    """The noise as the best effect leaves it; where other sensors' is coloured, all once more."""
    noise = with_colour(state.problem, state.best.fit)
    if noise.same(state.problem.noise):
        return state
    again = state.renoised(noise)
    if noise.colour.keys() == state.problem.noise.colour.keys():
        return again
    out = dropped("coloured noise", state.candidates, "the noise has another colour")
    again = replace(again, candidates=()).noting(*out)
    again = run_stages((nominal_rig, stiffness_or_damping_alone, single_effects), again, workers)
    if workers.stop.due and not any(c.names for c in again.candidates):
        return state.noting(*stopped_in(again.record[len(state.record) :]))  # no effect was fitted
    return again
