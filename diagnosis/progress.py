"""How far a diagnosis is: its stage in words, and an estimate of the time that is left of the whole."""

import time
from collections.abc import Callable
from dataclasses import dataclass

from diagnosis.stages import in_words
from diagnosis.stopping import StopSignal
from diagnosis.time_left import TimeLeft


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a diagnosis is.

    Attributes:
      stage: in words.
      done: tasks of the stage that are done.
      tasks: of the stage.
      elapsed_s: since the diagnosis began.
      left_s: estimates of the least and the most that the rest of it takes; None: too early to say.
    """

    stage: str
    done: int
    tasks: int
    elapsed_s: float
    left_s: tuple[float, float] | None


Watcher = Callable[[Progress], None]


def silent(news: Progress) -> None:
    """Progress that nobody watches."""


class ProgressClock:
    """Makes progress of what is heard of stages: their names, tasks that are done, and all tasks."""

    def __init__(self, watcher: Watcher, stop: StopSignal) -> None:
        """The clock runs from now on."""
        self._watcher, self._stop = watcher, stop
        self._began_s, self._left = time.monotonic(), TimeLeft()

    def heard(self, stage: str, done: int, tasks: int) -> None:
        """Tell the watcher, unless the stage has nothing to do."""
        elapsed_s = time.monotonic() - self._began_s
        self._left.heard(stage, done, tasks, elapsed_s)
        if not tasks:
            return
        self._watcher(
            Progress(
                stage=in_words(stage),
                done=done,
                tasks=tasks,
                elapsed_s=elapsed_s,
                left_s=self._within_the_limit(self._left.between_s()),
            )
        )

    def _within_the_limit(self, left_s: tuple[float, float] | None) -> tuple[float, float] | None:
        """Nothing takes longer than a limit leaves."""
        if self._stop.limit_s is None:
            return left_s
        limit_s = max(self._stop.left_s, 0.0)
        least_s, most_s = left_s or (0.0, limit_s)
        return min(least_s, limit_s), min(most_s, limit_s)
