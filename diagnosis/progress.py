"""How far a diagnosis is: its stage in words, and an estimate of the time that is left of the whole.

The stages take typical shares of the time. Once some have ended the pace is known,

    left = elapsed * (shares to come) / (shares that have passed),

where a stage that is skipped counts as passed. Stages that few logs need (sets of three effects,
free-form laws) have no share: while one of them runs nobody knows what is left, and its time says
nothing of the pace. A limit is known, and nothing takes longer.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass

from diagnosis.stopping import StopSignal


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a diagnosis is.

    Attributes:
      stage: in words.
      done: tasks of the stage that are done.
      tasks: of the stage.
      elapsed_s: since the diagnosis began.
      left_s: estimate for the rest of it; None: too early to say, or a stage that few logs need.
    """

    stage: str
    done: int
    tasks: int
    elapsed_s: float
    left_s: float | None


Watcher = Callable[[Progress], None]


def silent(news: Progress) -> None:
    """Progress that nobody watches."""


@dataclass(frozen=True, kw_only=True)
class _Usual:
    """A stage in words, and its share of a diagnosis in per cent, where it is typical."""

    words: str
    share_percent: float = 0.0


REPLAYING, CHECKING, ASSESSING = "nominal replay", "held-out trials", "assessment"
_STAGES = {
    REPLAYING: _Usual(words="replaying the nominal rig", share_percent=2.0),
    "nominal rig": _Usual(words="fitting the nominal rig", share_percent=6.0),
    "stiffness or damping alone": _Usual(words="fitting stiffness or damping alone"),
    "screening single effects": _Usual(words="screening single effects", share_percent=7.0),
    "single effects": _Usual(words="fitting single effects", share_percent=41.0),
    "finalists": _Usual(words="fitting the best single effects to the whole log", share_percent=10.0),
    "screening pairs": _Usual(words="screening pairs", share_percent=9.0),
    "pairs": _Usual(words="fitting pairs", share_percent=4.0),
    "finalists, pairs": _Usual(words="fitting the best pairs to the whole log", share_percent=2.0),
    "richer effects": _Usual(words="fitting richer effects of the best"),
    "finalists, richer effects": _Usual(words="fitting richer effects to the whole log"),
    "screening imperfections of sensors": _Usual(words="screening imperfections of sensors"),
    "imperfections of sensors": _Usual(words="fitting imperfections of sensors"),
    "finalists, imperfections of sensors": _Usual(
        words="fitting the best imperfections of sensors to the whole log"
    ),
    "screening three effects": _Usual(words="screening sets of three effects"),
    "three effects": _Usual(words="fitting sets of three effects"),
    "finalists, three effects": _Usual(words="fitting the best sets of three to the whole log"),
    "best to its end": _Usual(words="completing the fit of the best"),
    "best without each effect": _Usual(words="fitting the best without each of its effects"),
    "scatter of the best": _Usual(words="fitting stiffness and damping of the best freely"),
    "mesh refinement": _Usual(words="fitting with a finer mesh"),
    "finer mesh near the floor": _Usual(words="fitting with a finer mesh"),
    "finer mesh": _Usual(words="fitting with a finer mesh"),
    "what cannot be told apart": _Usual(words="looking for equivalent explanations"),
    CHECKING: _Usual(words="checking on held-out trials", share_percent=1.0),
    "other forms of a law": _Usual(words="comparing with other forms of a law"),
    ASSESSING: _Usual(words="assessing the best explanation", share_percent=2.0),
    "adding another effect": _Usual(words="adding another effect", share_percent=5.0),
    "screening free-form laws": _Usual(words="screening free-form laws"),
    "free-form laws": _Usual(words="fitting free-form laws"),
    "free-form laws beside an effect": _Usual(words="fitting free-form laws beside an effect"),
    "finalists, free-form laws": _Usual(words="fitting the best free-form laws to the whole log"),
    "detection limits": _Usual(words="computing detection limits", share_percent=10.0),
}
"""In their order. Shares are means of four logs, three with one effect and one with two; nothing depends
on them but the estimate of the time that is left. A stage without a share may come at any place, or not
at all, and take longer than all others."""
_LEAST_PASSED_PERCENT = 5.0  # of the shares, before which the pace says nothing


def in_words(stage: str) -> str:
    """A stage as people say what is done in it."""
    return _STAGES[stage].words if stage in _STAGES else stage


class ProgressClock:
    """Makes progress of what is heard of stages: their names, tasks that are done, and all tasks."""

    def __init__(self, watcher: Watcher, stop: StopSignal) -> None:
        """The clock runs from now on."""
        self._watcher, self._stop = watcher, stop
        self._began_s = time.monotonic()
        self._passed_percent = 0.0
        self._last_s, self._expected, self._unexpected_s = 0.0, True, 0.0

    def heard(self, stage: str, done: int, tasks: int) -> None:
        """Tell the watcher."""
        self._passed_percent = max(self._passed_percent, _passed(stage, done, tasks))
        elapsed_s = time.monotonic() - self._began_s
        if not self._expected:
            self._unexpected_s += elapsed_s - self._last_s
        self._last_s, self._expected = elapsed_s, _share_percent(stage) > 0
        self._watcher(
            Progress(
                stage=in_words(stage),
                done=done,
                tasks=tasks,
                elapsed_s=elapsed_s,
                left_s=self._left(elapsed_s),
            )
        )

    def _left(self, elapsed_s: float) -> float | None:
        limit_s = self._stop.left_s
        if not self._expected or self._passed_percent < _LEAST_PASSED_PERCENT:
            return max(limit_s, 0.0) if self._stop.limit_s else None
        pace_s = (elapsed_s - self._unexpected_s) / self._passed_percent
        left_s = pace_s * (_ALL_PERCENT - self._passed_percent)
        return max(min(left_s, limit_s), 0.0)


_ALL_PERCENT = sum(usual.share_percent for usual in _STAGES.values())


def _share_percent(stage: str) -> float:
    """Of a diagnosis; 0: few need this stage."""
    return _STAGES[stage].share_percent if stage in _STAGES else 0.0


def _passed(stage: str, done: int, tasks: int) -> float:
    """Shares of all stages before one, and of its tasks that are done; 0: its place is not known."""
    if not _share_percent(stage):
        return 0.0
    names = list(_STAGES)
    before = sum(_STAGES[name].share_percent for name in names[: names.index(stage)])
    return before + _STAGES[stage].share_percent * done / max(tasks, 1)
