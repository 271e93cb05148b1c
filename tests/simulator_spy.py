"""Watching what a diagnosis simulates."""

from collections import Counter
from contextlib import AbstractContextManager

import pytest

from diagnosis import nominal_replay, pipeline
from diagnosis.assessment import nearest
from diagnosis.replay import replay
from diagnosis.selection import candidate


class SimulatorSpy(AbstractContextManager):
    """While it is open, counts needles, nominal replays and held-out replays.

    Attributes:
      needles: that were simulated.
      nominal: replays of the nominal rig before the search.
      held_out: replays of held-out trials, by stage and the effects of the candidate.
      assessed: the log itself and the decimated log that the assessment got.
    """

    def __init__(self):
        self.needles, self.nominal = 0, 0
        self.held_out = {"search": Counter(), "assessment": Counter()}
        self.assessed = None
        self._patch = pytest.MonkeyPatch()

    def __enter__(self):
        self._patch.setattr(replay, "simulate", self._watched(replay.simulate, self._needles))
        self._patch.setattr(
            nominal_replay, "replay", self._watched(nominal_replay.replay, self._nominal)
        )
        self._patch.setattr(pipeline, "assess", self._watched(pipeline.assess, self._assessed))
        for stage, module, name in (
            ("search", candidate, "held_out_or_refitted"),
            ("assessment", nearest, "held_out_or_refitted"),
        ):
            count = self._counter(self.held_out[stage])
            self._patch.setattr(module, name, self._watched(getattr(module, name), count))
        return self

    def __exit__(self, *_):
        self._patch.undo()

    def _watched(self, function, count):
        def watching(*arguments, **options):
            count(*arguments)
            return function(*arguments, **options)

        return watching

    def _needles(self, setups, *_):
        self.needles += len(setups)

    def _nominal(self, *_):
        self.nominal += 1

    def _assessed(self, _, problem, coarse, *__):
        self.assessed = (problem, coarse)

    def _counter(self, counts):
        return lambda _, fit, *__: counts.update([fit.names])
