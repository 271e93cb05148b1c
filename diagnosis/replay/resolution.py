"""The resolution of a replay in space and time."""

from dataclasses import dataclass

from diagnosis.prepare.prepared_log import PreparedTrial


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """Elements of the inserted needle, and the longest step, s."""

    elements: int
    step_s: float

    def step_of(self, trial: PreparedTrial) -> float:
        """Time step for a trial, s: its sampling interval, or the longest step if that is shorter."""
        return min(self.step_s, trial.sample_s)


FINE = Resolution(elements=12, step_s=0.01)
"""Of the log itself: mostly a few hundredths of the noise from the limit of fine steps."""
COARSE = Resolution(elements=6, step_s=0.04)
"""Of the decimated log, ten times cheaper."""
