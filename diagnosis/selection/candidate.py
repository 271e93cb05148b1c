"""A fitted explanation: its score, what it names, and whether it explains the log."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import (
    SCATTER,
    SCATTER_ALIKE,
    SCATTER_NAMED,
)
from diagnosis.criteria.selection import (
    HELD_OUT_GAP,
    SCATTER_CERTAIN_SIGMA,
    SCATTER_LEAST,
    SHIFT_LIMIT,
    SIMPLE_LEAD,
)
from diagnosis.effects import FITTED, LIBRARY
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.held_out.cross_validation import shift_statistic
from diagnosis.fitting.held_out.refits import held_out_or_refitted
from diagnosis.fitting.noise_floor import NoiseFloor, floor_of
from diagnosis.fitting.noise_reestimation import slow_where_coloured
from diagnosis.fitting.nuisance import late_starts_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.fitting.swinging import swinging_where_coloured
from diagnosis.selection.scoring.complexity import complexity_penalty
from diagnosis.selection.scoring.own_values import gain_of_own_values
from diagnosis.selection.scoring.scatter import gain_of_exact_constants, open_scatter, scatter_of
from diagnosis.selection.scoring.unresolved import unresolved_cost, unresolved_law_cost
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Candidate:
    """A fitted explanation.

    Attributes:
      score: cost plus complexity penalty, less what exact constants gain, and what clocks do that run
        off by another rate in each trial; the least is best.
      floor: how far its residual is above the noise.
      held_out: residuals / sigma of each trial, predicted from the others; None: not looked at.
      held_out_floor: how far these are above the noise.
      held_out_failure: why they could not be simulated; empty: they could, or were not looked at.
      shift: held-out shift statistic; about 1 where all trials tell the same.
      shift_limit: largest that is of an explanation.
      means_of: readings that a sample is the mean of: its noise may be below what a replay resolves.
      begun_late: whether trials began wound up or moving, of which little of what was before is known.
      unresolved_cost: cost by which it may lead for what no model of a needle resolves.
      unresolved_law_cost: cost by which it may lead a part of it for what laws of effects leave open.
      base_noise_cost: cost that the noise of the encoder makes, for a late sensor alone; else 0.
      coloured: floors of the sensors whose noise is, with a slow part over seconds.
      swinging_hz: frequencies at which sensors with coloured noise swing, as no noise does.
      shape_open: whether typical forms of its law explain the log too: a bound is nothing against it.
    """

    fit: Fit
    score: float
    floor: NoiseFloor
    held_out: tuple[Array, ...] | None = None
    held_out_floor: NoiseFloor | None = None
    held_out_failure: str = ""
    shift: float = 0.0
    shift_limit: float = SHIFT_LIMIT
    means_of: int = 1
    begun_late: bool = False
    unresolved_cost: float = 0.0
    unresolved_law_cost: float = 0.0
    base_noise_cost: float = 0.0
    coloured: Mapping[str, NoiseFloor] = field(default_factory=dict)
    swinging_hz: Mapping[str, float] = field(default_factory=dict)
    shape_open: bool = False

    @property
    def lead_over_part(self) -> float:
        """Score by which it has to lead a part of it that explains the log to be named in its place."""
        return max(SIMPLE_LEAD, self.unresolved_law_cost)

    @property
    def explains(self) -> bool:
        """Whether nothing beyond noise is left, also on trials that the fit has not seen."""
        return not self.objection

    @property
    def objection(self) -> str:
        """Why it does not explain the log first of all, in words; empty: it does."""
        return next(self._objections(), "")

    @property
    def objections(self) -> str:
        """All that speaks against it, in words; empty: nothing does."""
        return "; ".join(self._objections())

    @property
    def refused_for_values(self) -> bool:
        """Whether it would explain the log, but for parameters at a bound or as good as none."""
        values = bool(self.reached_bounds) + bool(self.as_good_as_none)
        return values == len(list(self._objections())) > 0

    @property
    def refused_as_none(self) -> bool:
        """Whether it would explain the log, but for parameters that are as good as none."""
        return bool(self.as_good_as_none) and len(list(self._objections())) == 1

    def _objections(self) -> Iterator[str]:
        floor = self.floor
        if not floor.small:
            yield f"above the noise floor: residual {floor.gap:.3f} σ, limit {floor.gap_limit:.3f}"
        if floor.slow > floor.slow_limit:
            yield f"not white: slow part {floor.slow:.3f} σ, limit {floor.slow_limit:.3f}"
        if self.reached_bounds:
            yield f"stopped at a bound: {', '.join(self.reached_bounds)}; no real rig is like that"
        if self.as_good_as_none:
            yield f"as good as none: {', '.join(self.as_good_as_none)}; it imitates another effect"
        if floor.reached and self.held_out is None:
            yield f"held-out trials cannot be simulated: {self.held_out_failure or 'not tried'}"
        for sensor, own in self.coloured.items():
            if own.slow > own.slow_limit:
                seen = f"{own.slow:.2f} times what its noise makes it, limit {own.slow_limit:.2f}"
                yield f"{sensor}, averaged over seconds, is off by {seen}"
        for sensor, hertz in self.swinging_hz.items():
            yield f"{sensor} swings at {hertz:.2g} Hz, as no noise does"
        if self.held_out_floor and self.held_out_floor.gap > HELD_OUT_GAP:
            yield f"held-out trials are {self.held_out_floor.gap:.3g} σ off, limit {HELD_OUT_GAP:.3g} σ"
        if self.shift > self.shift_limit:
            times = f"{self.shift:.1f} times what the uncertainty of the parameters makes it"
            yield f"predictions of held-out trials shift by {times}, limit {self.shift_limit:.3g}"
        if self.unidentifiable:
            yield "stiffness or damping is off, but it is open which"

    def cross_validated(self, problem: FitProblem) -> "Candidate":
        """The same with held-out trials, if it is at the noise floor."""
        if not self.floor.reached:
            return self
        try:
            left = held_out_or_refitted(problem, self.fit)
            of_laws = unresolved_law_cost(problem, self.fit)
        except SimulationFailed as failed:
            return replace(self, held_out_failure=str(failed))
        return replace(
            self,
            held_out=left,
            held_out_floor=floor_of(left),
            shift=shift_statistic(self.fit),
            means_of=problem.log.means_of,
            begun_late=bool(late_starts_of(problem.log)),
            unresolved_cost=unresolved_cost(problem),
            unresolved_law_cost=of_laws,
            coloured=slow_where_coloured(problem, self.fit.by_trial),
            swinging_hz=swinging_where_coloured(problem, self.fit.by_trial),
        )

    @property
    def reached_bounds(self) -> tuple[str, ...]:
        """Of named effects, those at a bound which say that no real rig is like that."""
        if self.shape_open:
            return ()
        return tuple(name for name in self.told_at_bound if name.partition(".")[0] in LIBRARY)

    @property
    def told_at_bound(self) -> tuple[str, ...]:
        """Parameters that are reported and stopped at a bound, as effect.parameter."""
        told = {f"{name}.{p.name}" for name in self.names for p in FITTED[name].reported}
        return tuple(name for name in self.fit.status.at_bound if name in told)

    @property
    def as_good_as_none(self) -> tuple[str, ...]:
        """Parameters that are hardly off their neutral values, as effect.parameter."""
        own = self.fit.parameterization
        each = zip(own.owners, own.parameters, own.values(self.fit.x), strict=True)
        return tuple(
            f"{owner}.{p.name}"
            for owner, p, value in each
            if p.distance_from_neutral(value) < p.least_factor
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects; none for the nominal rig."""
        return self.fit.names

    @property
    def named(self) -> tuple[str, ...]:
        """Its effects, and stiffness or damping of the rig where they are off by too much.

        Beside effects that is more than scatter explains. Without any it is whatever is
        certain: the nominal rig does not fit, and this is why. Imperfections of sensors
        are no effects, and not named.
        """
        own = (name for name in self.names if name in LIBRARY)
        return (*own, *self.scatter_named)

    @property
    def scatter_named(self) -> tuple[str, ...]:
        """Stiffness or damping of the rig, where they are off by too much."""
        return tuple(n for n in open_scatter(self.fit) if self._is_off(n))

    @property
    def only_scatter(self) -> bool:
        """Whether it is stiffness or damping alone."""
        return bool(self.names) and set(self.names) <= set(SCATTER)

    @property
    def only_late(self) -> bool:
        """Whether it names a delay of a sensor, and nothing else."""
        return len(self.named) == 1 and FITTED[self.named[0]].delays_a_sensor

    @property
    def unidentifiable(self) -> bool:
        """Whether stiffness and damping are off for certain, and it is open which: a ratio shows."""
        return not self.named and self.jointly_significant

    @property
    def jointly_significant(self) -> bool:
        """Whether stiffness and damping, together, are off for certain."""
        away, spread = scatter_of(self.fit)
        off = away @ np.linalg.pinv(spread) @ away > SCATTER_CERTAIN_SIGMA**2
        return bool(off) and float(np.abs(away).sum()) > SCATTER_LEAST

    def _is_off(self, name: str) -> bool:
        if any(other in LIBRARY for other in self.names):
            return abs(self._scatters(name)) > SCATTER_NAMED or self._off_alike
        away, spread = scatter_of(self.fit)
        entry = open_scatter(self.fit).index(name)
        certain = SCATTER_CERTAIN_SIGMA * float(np.sqrt(spread[entry, entry]))
        return abs(float(away[entry])) > max(certain, SCATTER_LEAST)

    def _scatters(self, name: str) -> float:
        """By how much a constant is off, in standard deviations of what it scatters by."""
        return math.expm1(float(self.fit.parts[name][0])) / SCATTER[name]  # fitted as log of the scale

    @property
    def _off_alike(self) -> bool:
        """Whether stiffness and damping are off by the same, as far as is told, and by too much."""
        both = open_scatter(self.fit)
        if len(both) != len(SCATTER):
            return False
        (one, other), spread = scatter_of(self.fit)
        apart = math.sqrt(max(spread[0, 0] + spread[1, 1] - 2 * spread[0, 1], 0.0))
        alike = abs(one - other) <= SCATTER_NAMED * apart <= min(SCATTER.values())
        return alike and math.hypot(*(self._scatters(name) for name in both)) > SCATTER_ALIKE


def candidate(fit: Fit) -> Candidate:
    """A fit with its score and noise floor."""
    score = fit.cost + complexity_penalty(fit) - gain_of_exact_constants(fit) - gain_of_own_values(fit)
    return Candidate(fit=fit, score=score, floor=floor_of(fit.by_trial))
