"""What a search has come to: the problem, fine and coarse, what was fitted, and the record."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from diagnosis.fitting.decimation import decimated_noise
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.faults.left_out import LeftOut
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.checked import Checked, check
from diagnosis.selection.fitting import Made
from diagnosis.selection.record import RecordEntry

Candidates = tuple[Candidate, ...]
Convert = Callable[[Fit, FitProblem, FitProblem], Fit]
"""A fit of a problem, in units of another one, from both."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SearchState:
    """What a search has come to.

    Attributes:
      problem: the log itself, replayed as finely as it asks.
      coarse: the decimated log.
      effects: that may be tried.
      nominal: the nominal rig, exactly as rig.yaml says.
      candidates: fitted on the log itself.
      singles: single effects, fitted on the decimated log, best first.
      pairs, triples: the same of two and three effects.
      checked: candidates as they were last checked.
      open_effects: that may be there, hidden by what is allowed for.
      left_out: readings that are outliers beside the explanation.
      record: of every stage so far.
    """

    problem: FitProblem
    coarse: FitProblem
    effects: tuple[str, ...]
    nominal: Fit
    candidates: tuple[Candidate, ...] = ()
    singles: tuple[Candidate, ...] = ()
    pairs: tuple[Candidate, ...] = ()
    triples: tuple[Candidate, ...] = ()
    checked: Checked | None = None
    open_effects: tuple[str, ...] = ()
    left_out: tuple[LeftOut, ...] = ()
    record: tuple[RecordEntry, ...] = ()

    @property
    def best(self) -> Candidate:
        """Of least score."""
        return min(self.candidates, key=lambda c: c.score)

    def about_as_near(self, names: Sequence[str], leaves: float) -> list[Candidate]:
        """Sets of as many effects that leave little more on the decimated log, smallest residual first.

        Args:
          leaves: residual over that of these effects, up to which they do.
        """
        alike = {1: self.singles, 2: self.pairs}.get(len(names), self.triples)
        own = [c.fit.gap for c in alike if {*c.names} == {*names}]
        near = [c for c in alike if own and c.fit.gap <= leaves * min(own)]
        return sorted(near, key=lambda c: c.fit.gap)

    def adding(self, made: Made) -> "SearchState":
        """The state with more candidates."""
        found, record = made
        return replace(self, candidates=(*self.candidates, *found), record=(*self.record, *record))

    def rechecked(self) -> tuple["SearchState", bool]:
        """The state with its candidates checked, and whether one of them explains the log."""
        checked = check(self.problem, self.candidates, self.checked)
        return replace(self, checked=checked), checked.explains

    def at_the_floor(self, one: Candidate) -> bool:
        """Whether a candidate that was checked leaves nothing beyond noise."""
        found = self.checked.of(one.fit, self.checked.noise) if self.checked else None
        return found is not None and found.floor.reached

    def renoised(self, noise: Noise) -> "SearchState":
        """The state in units of another noise."""
        fine, coarse = self.problem, self.coarse
        rare = decimated_noise(noise, fine.log, coarse.log)
        return self.converted(
            replace(fine, noise=noise),
            replace(coarse, noise=rare),
            lambda fit, before, after: rescaled(fit, before, after.noise),
        )

    def converted(self, fine: FitProblem, coarse: FitProblem, convert: Convert) -> "SearchState":
        """The state of other problems, with all that was fitted in units of them."""

        def each(found: Sequence[Candidate], before: FitProblem, after: FitProblem) -> Candidates:
            return tuple(candidate(convert(c.fit, before, after)) for c in found)

        return replace(
            self,
            problem=fine,
            coarse=coarse,
            nominal=convert(self.nominal, self.problem, fine),
            candidates=each(self.candidates, self.problem, fine),
            singles=each(self.singles, self.coarse, coarse),
            pairs=each(self.pairs, self.coarse, coarse),
            triples=each(self.triples, self.coarse, coarse),
        )

    def noting(self, *entries: RecordEntry) -> "SearchState":
        """The state with a longer record."""
        return replace(self, record=(*self.record, *entries))
