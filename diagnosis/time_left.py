"""Between which limits the time lies that a diagnosis still takes.

A task of a stage has a usual time u. Tasks that are done give the pace, by itself for fits to the
decimated and to the whole log, as their ratio differs from log to log:

    pace = (time that they took) / (sum of their u),    left = sum over tasks to come of pace * u.

How many come depends on what explains the log. Where one effect does, most stages are short or skipped;
where nothing does, none is. As long as this is open, the time that is left lies between these two.
"""

from collections.abc import Iterable

from diagnosis.stages import ALIKE, REPLAYING, SCREENING_PAIRS, STAGES, Log, Usual, usual

_ORDER = list(STAGES)
_LEAST_DONE_S = 1.0  # usual time of the tasks that are done, before which the pace says nothing


class TimeLeft:
    """What is heard of stages, as an estimate of the time that is left."""

    def __init__(self) -> None:
        """Nothing has been heard."""
        self._took_s, self._usual_s = dict.fromkeys(Log, 0.0), dict.fromkeys(Log, 0.0)
        self._stage, self._at_s = REPLAYING, 0.0
        self._done = self._tasks = self._before = 0
        self._place = REPLAYING  # the last stage that began, if its place in the order is known
        self._explained = False

    def heard(self, stage: str, done: int, tasks: int, at_s: float) -> None:
        """Take note of a stage, with its tasks that are done and all of them."""
        if self._stage != REPLAYING:  # which may have waited for a compiler
            self._took_s[usual(self._stage).log] += at_s - self._at_s
        if stage != self._stage:
            self._before = self._done = 0
            if not done:  # else it goes on, after another within it
                self._begin(stage, tasks)
        elif done < self._done:  # more tasks of the same stage
            self._before, self._done = self._before + self._done, 0
        self._usual_s[usual(stage).log] += usual(stage).task_s * (done - self._done)
        self._stage, self._done, self._tasks, self._at_s = stage, done, tasks, at_s

    def _begin(self, stage: str, tasks: int) -> None:
        if stage not in STAGES:
            return
        self._place = stage
        if stage == SCREENING_PAIRS:
            self._explained = tasks <= usual(stage).least
        elif tasks and stage == ALIKE:
            self._explained = True
        elif tasks and not usual(stage).least and usual(stage).most:
            self._explained = False

    def between_s(self) -> tuple[float, float] | None:
        """The least and the most that is left, s; None: too little is done to say."""
        if sum(self._usual_s.values()) < _LEAST_DONE_S:
            return None
        least_s = self._left_s(most=False)
        return least_s, least_s if self._explained else self._left_s(most=True)

    def _left_s(self, *, most: bool) -> float:
        now, later = usual(self._stage), _ORDER[_ORDER.index(self._place) + 1 :]
        to_come = max(self._tasks, _tasks(now, most=most) - self._before) - self._done
        return self._takes_s(now, to_come) + self._all_s(later, most=most)

    def _all_s(self, stages: Iterable[str], *, most: bool) -> float:
        return sum(self._takes_s(usual(s), _tasks(usual(s), most=most)) for s in stages)

    def _takes_s(self, stage: Usual, tasks: int) -> float:
        """What tasks of a stage take at the pace of their kind, or of all."""
        own = [stage.log] if self._usual_s[stage.log] > 0 else list(Log)
        pace = sum(self._took_s[log] for log in own) / sum(self._usual_s[log] for log in own)
        return pace * stage.task_s * tasks


def _tasks(stage: Usual, *, most: bool) -> int:
    return stage.most if most else stage.least
