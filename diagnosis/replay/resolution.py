"""The resolution of a replay in space and time."""

from dataclasses import dataclass, replace

from diagnosis.prepare.prepared_log import PreparedTrial
from sim.discretisation import LONGEST_STEP_S


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """Elements of the inserted needle, and the longest step: in s, and in samples of the trial."""

    elements: int
    step_s: float
    step_samples: int = 1

    def step_of(self, trial: PreparedTrial) -> float:
        """Time step for a trial, s."""
        return min(self.step_s, self.step_samples * trial.sample_s)

    @property
    def halved(self) -> "Resolution":
        """Half as fine in space and time, as far as a simulation goes."""
        return Resolution(
            elements=self.elements // 2,
            step_s=min(2 * self.step_s, LONGEST_STEP_S),
            step_samples=2 * self.step_samples,
        )

    @property
    def refined(self) -> "Resolution":
        """Twice as fine in space and time, but for a step of one sample."""
        return replace(self, elements=2 * self.elements, step_s=self.step_s / 2)


FINE = Resolution(elements=12, step_s=0.01)
"""Of the log itself: mostly a few hundredths of the noise from the limit of fine steps."""
COARSE = Resolution(elements=6, step_s=0.04)
"""Of the decimated log, ten times cheaper."""
