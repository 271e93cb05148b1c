"""The resolution of a replay in space and time."""

from dataclasses import dataclass, replace

from diagnosis.prepare.prepared_log import PreparedTrial
from sim.discretisation import LONGEST_STEP_S

_ROUNDING = 1e-6  # of logged times, in samples


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """Elements of the inserted needle, and the longest step, s."""

    elements: int
    step_s: float

    def step_of(self, trial: PreparedTrial) -> float:
        """Time step for a trial, s: as many whole samples as the longest step holds, or that step."""
        samples = max(1, int(self.step_s / trial.sample_s + _ROUNDING))
        return min(self.step_s, samples * trial.sample_s)

    @property
    def halved(self) -> "Resolution":
        """Half as fine in space and time, as far as a simulation goes."""
        return replace(self, elements=self.elements // 2, step_s=min(2 * self.step_s, LONGEST_STEP_S))

    @property
    def nearer_the_usual(self) -> "Resolution":
        """Half as fine, as long as that is no coarser than what logs are replayed with; or itself."""
        return replace(
            self,
            elements=max(self.elements // 2, min(self.elements, FINE.elements)),
            step_s=min(2 * self.step_s, max(self.step_s, FINE.step_s)),
        )

    @property
    def refined(self) -> "Resolution":
        """Twice as fine in space and time."""
        return replace(self, elements=2 * self.elements, step_s=self.step_s / 2)


FINE = Resolution(elements=12, step_s=0.01)
"""Of the log itself: mostly a few hundredths of the noise from the limit of fine steps."""
COARSE = Resolution(elements=6, step_s=0.04)
"""Of the decimated log, ten times cheaper."""
