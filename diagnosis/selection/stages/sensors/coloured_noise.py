"""The colour of the noise, once an effect is known.

Where that is another, effects are fitted once more, from where they are; and again at the end, in the
noise that the best of them leaves. Where nothing explains a log, and the best leaves little, a colour
that shows less is allowed for if it does; and noise may go on as 1 / f. Where it shows that at
frequencies at which effects leave little, that is enough; where it begins below, both sensors have to
show it, what is left of them must have nothing in common, little may be left, and one effect may be
beside it at most, as beside a drift. The former is looked for before more effects are, where the best
leaves no more than noise does; else both come last.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from diagnosis.criteria.noise import (
    COLOUR_ABOVE_HZ,
    COLOUR_CHI_SQUARE,
    COLOUR_OPEN,
    COLOUR_WEAK_CHI_SQUARE,
    COLOUR_WEAK_GAP,
    FLICKER_ABOVE_HZ,
    FLICKER_COMMON_SIGMA,
    OTHER_COLOUR_GAP,
)
from diagnosis.criteria.selection import DRIFT_MOST_EFFECTS
from diagnosis.fitting.noise_reestimation import flicker_left, with_colour
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.selection.record import Decision, dropped, noted
from diagnosis.selection.scoring.common_part import common_part
from diagnosis.selection.stages.nominal_rig import nominal_rig, stiffness_or_damping_alone
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.selection.stages.stage import leading_fitted_again, run_stages, stopped_in
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE, OF_THE_BEST, WEAK = "coloured noise", "noise of the best", "weakly coloured noise"
FLICKER, FLICKER_SHOWS = "flicker noise", "flicker noise that shows"


def coloured_noise(state: SearchState, workers: Workers) -> SearchState:
    """The noise as the best effect leaves it; where other sensors' is coloured, all once more."""
    noise = with_colour(state.problem, state.best.fit)
    if noise.same(state.problem.noise):
        return state
    again = state.renoised(noise)
    if noise.colour.keys() == state.problem.noise.colour.keys():
        return again
    out = dropped(STAGE, state.candidates, "the noise has another colour")
    again = replace(again, candidates=()).noting(*out)
    again = run_stages((nominal_rig, stiffness_or_damping_alone, single_effects), again, workers)
    if workers.stop.due and not any(c.names for c in again.candidates):
        return state.noting(*stopped_in(again.record[len(state.record) :]))  # no effect was fitted
    return again


def noise_of_the_best(state: SearchState, workers: Workers) -> SearchState:
    """The leading explanations, fitted anew where the best leaves noise of another colour.

    What nothing had explained so far may have passed for noise: parameters that were fitted beside that
    are less certain than the noise that is left would make them.
    """
    noise = with_colour(state.problem, state.best.fit)
    if noise.colour == state.problem.noise.colour:
        return state
    begun = state.renoised(noise)
    made = leading_fitted_again(OF_THE_BEST, begun, begun.problem, workers)
    anew = {frozenset(c.names) for c in made[0]}
    others = tuple(c for c in begun.candidates if frozenset(c.names) not in anew)
    return replace(begun, candidates=others).adding(made)


def weakly_coloured_noise(state: SearchState, workers: Workers) -> SearchState:
    """The state with noise of a colour that shows less, where only that explains the log."""
    state, explained = state.rechecked()
    if explained or state.best.fit.gap > COLOUR_WEAK_GAP:
        return state
    asked = replace(state.problem.noise, colour_chi_square=COLOUR_WEAK_CHI_SQUARE)
    noise = with_colour(replace(state.problem, noise=asked), state.best.fit)
    if noise.same(state.problem.noise) or not _may_explain(state.renoised(noise), apart=False):
        return state
    return _kept_if_it_explains(WEAK, state, noise, workers)


def flicker_noise(state: SearchState, workers: Workers) -> SearchState:
    """The state with noise that goes on as 1 / f, where only that explains the log."""
    return _with_flicker(FLICKER, state, workers, (_coloured_flicker, _slow_flicker))


def flicker_noise_that_shows(state: SearchState, workers: Workers) -> SearchState:
    """The same, where what the best leaves is as small as noise, though not as white, and shows that at
    frequencies at which effects leave little."""
    if not state.best.floor.small:
        return state
    return _with_flicker(FLICKER_SHOWS, state, workers, (_coloured_flicker,))


def _with_flicker(
    stage: str,
    state: SearchState,
    workers: Workers,
    shown: Sequence[Callable[[SearchState], dict[str, float]]],
) -> SearchState:
    for sensors in shown:
        state, explained = state.rechecked()
        if explained:
            break
        slow = sensors is _slow_flicker
        allowed = sensors(state)
        if not allowed:
            continue
        noise = replace(state.problem.noise, flicker=allowed)
        noise = with_colour(replace(state.problem, noise=noise), state.best.fit)
        contenders = _with_few_effects(state) if slow else state
        if contenders.candidates and _may_explain(contenders.renoised(noise), apart=slow):
            state = _kept_if_it_explains(stage, state, noise, workers, contenders)
    return state


def _coloured_flicker(state: SearchState) -> dict[str, float]:
    """Sensors whose noise shows it where effects leave little, and the frequency above which that is."""
    found = flicker_left(state.problem, state.best.fit, COLOUR_ABOVE_HZ)
    little = state.best.fit.gap <= COLOUR_WEAK_GAP
    asked = COLOUR_WEAK_CHI_SQUARE if little else COLOUR_CHI_SQUARE
    told = (
        s for s, own in found.items() if own.gain_cost >= asked and own.behind_cost <= COLOUR_CHI_SQUARE
    )
    return dict.fromkeys(told, COLOUR_ABOVE_HZ)


def _slow_flicker(state: SearchState) -> dict[str, float]:
    """The same where all of it is slow: both sensors have to show it, and little else may be left."""
    if state.best.fit.gap > COLOUR_WEAK_GAP:
        return {}
    found = flicker_left(state.problem, state.best.fit, FLICKER_ABOVE_HZ)
    gains = [own.gain_cost for own in found.values()]
    told = len(gains) == len(SENSORS) and min(gains) >= COLOUR_OPEN and sum(gains) >= COLOUR_CHI_SQUARE
    return dict.fromkeys(found, FLICKER_ABOVE_HZ) if told else {}


def _with_few_effects(state: SearchState) -> SearchState:
    """The state without explanations of more effects than may be beside a drift, which is slow too."""
    few = (c for c in state.candidates if len(c.named) <= DRIFT_MOST_EFFECTS)
    return replace(state, candidates=tuple(few))


def _may_explain(state: SearchState, *, apart: bool) -> bool:
    """Whether a leading explanation leaves little in that noise.

    Args:
      apart: whether what it leaves of tip and torque has to have nothing in common.
    """
    best = min((c.fit for c in state.candidates), key=lambda fit: fit.gap)
    alike = abs(common_part(state.problem, best)) > FLICKER_COMMON_SIGMA if apart else False
    return best.gap <= OTHER_COLOUR_GAP and not alike


def _kept_if_it_explains(
    stage: str,
    state: SearchState,
    noise: Noise,
    workers: Workers,
    contenders: SearchState | None = None,
) -> SearchState:
    """The leading explanations fitted again in another noise, if one of them explains the log there.

    Args:
      contenders: the state with the explanations that may; None: all of them.
    """
    begun = (contenders or state).renoised(noise)
    made = leading_fitted_again(stage, begun, begun.problem, workers)
    again, explained = replace(begun, candidates=()).adding(made).rechecked()
    if explained:
        return again.noting(noted(stage, Decision.KEPT, "with it the log is explained"))
    return state.noting(noted(stage, Decision.DROPPED, "no explanation reaches the noise with it"))
