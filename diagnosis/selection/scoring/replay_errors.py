"""How much of a lead over a part of an explanation, or over a rival, errors of the replay may have made.

One more effect, or another one, may take up what a replay does wrong: noise of the base's encoder that
is left in the motion that drives it, what smoothing rounds off this motion, and the error of mesh and
step. Let d be the difference between the residuals of the two, in units of the noise. Its square is the
lead in cost over a part. Errors m of the residual change it along d by m' d / |d|, with the mean square
s^2 over several readings of the encoder; noise has the variance 1 there. So a lead in cost counts as

    lead / (1 + s^2).

What a part needs of the prior, as of stiffness or damping that it does not name, is no error's doing.

Two rivals may each lead a part, and errors may be more like the lead of one of them: between these two
their own difference decides, also where the other has lost more of its lead than a rival is behind.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import BASE_NOISE_READINGS
from diagnosis.criteria.selection import CONTENDING, SIMPLE_LEAD
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]

_SEED = 22


def without_replay_errors(problem: FitProblem, candidates: Sequence[Candidate]) -> list[Candidate]:
    """Candidates with scores that count no lead over a part or a rival that errors may have made.

    Args:
      candidates: checked, in units of the noise of the problem.
    """
    replays = _Replays(problem)
    at_floor = [c for c in candidates if c.floor.reached]
    pairs = [(_scored(replays, one, at_floor), one) for one in candidates]
    ranked = sorted(pairs, key=lambda pair: pair[0].score)
    return sorted(_with_rivals_nearer(replays, ranked), key=lambda c: c.score)


class _Replays:
    """A problem, and the same ones whose replays err in other ways; they are made when asked for."""

    def __init__(self, problem: FitProblem) -> None:
        """The problem itself."""
        self.problem = problem

    @property
    def finer(self) -> FitProblem:
        """With a finer mesh and step."""
        return replace(self.problem, resolution=self.problem.resolution.refined)

    @cached_property
    def read_again(self) -> list[FitProblem]:
        """With other readings of the base's encoder."""
        rng = np.random.default_rng(_SEED)
        return [self.problem.read_again(rng) for _ in range(BASE_NOISE_READINGS)]


def _scored(replays: _Replays, one: Candidate, at_floor: Sequence[Candidate]) -> Candidate:
    parts = [c for c in at_floor if {*c.names} < {*one.names} and c.fit.cost > one.fit.cost]
    if not parts or not one.floor.reached:
        return one
    try:
        errors = list(_errors(replays, one))
    except SimulationFailed:
        return one
    needless = max(_needless(one, part, errors) for part in parts)
    return replace(one, score=one.score + needless)


def _with_rivals_nearer(
    replays: _Replays, ranked: Sequence[tuple[Candidate, Candidate]]
) -> list[Candidate]:
    """Candidates, those that the best leads by a little as near to it as errors may bring them.

    Args:
      ranked: each with the score that counts, best first, and with its own.
    """
    known = [one for one, _ in ranked]
    first = next((pair for pair in ranked if pair[0].explains), None)
    if first is None or not any(_is_rival(first, pair) for pair in ranked):
        return known
    best, own = first
    try:
        errors = list(_errors(replays, best))
    except SimulationFailed:
        return known
    return [
        replace(one, score=min(one.score, best.score + _lead(own, bare, errors)))
        if _is_rival(first, (one, bare))
        else one
        for one, bare in ranked
    ]


def _is_rival(first: tuple[Candidate, Candidate], pair: tuple[Candidate, Candidate]) -> bool:
    """Whether it explains the log as well, by something else, and its lead would decide.

    Args:
      first, pair: the best and another one, each with the score that counts, and with its own.
    """
    best, other = first[0], pair[0]
    else_ = not ({*best.names} <= {*other.names} or {*other.names} <= {*best.names})
    near = any(one.score - ahead.score <= CONTENDING for ahead, one in zip(first, pair, strict=True))
    return other.explains and else_ and near and other.score - best.score > SIMPLE_LEAD


def _lead(best: Candidate, rival: Candidate, errors: Sequence[Array]) -> float:
    """By how much a rival is behind, without what errors may have made of that."""
    return rival.score - best.score - _needless(best, rival, errors)


def _needless(one: Candidate, part: Candidate, errors: Sequence[Array]) -> float:
    """How much of the lead in cost over a part errors may have made."""
    apart = np.concatenate(part.fit.by_trial) - np.concatenate(one.fit.by_trial)
    length = float(np.linalg.norm(apart))
    if length == 0.0:
        return 0.0
    square = float(np.mean([(error @ apart / length) ** 2 for error in errors]))
    lead = (part.fit.cost - part.fit.prior) - (one.fit.cost - one.fit.prior)
    return max(lead, 0.0) * square / (1.0 + square)


def _errors(replays: _Replays, one: Candidate) -> Iterator[Array]:
    """Changes of the residual of an explanation from reading to reading of the encoder, (N,) each."""
    rig = one.fit.parameterization.rig(one.fit.x)
    here, there = (p.residuals([rig], callback_alone=True) for p in (replays.problem, replays.finer))
    mesh = _change(there, here)
    for again in replays.read_again:
        yield mesh + _change(again.residuals([rig], callback_alone=True), here)


def _change(runs: Sequence[Sequence[Array]], here: Sequence[Sequence[Array]]) -> Array:
    return np.concatenate([run[0] - left[0] for run, left in zip(runs, here, strict=True)])
