"""What several pages need to run what they show."""

import time

import pytest

from diagnosis.stopping import StopSignal

FOREVER_S = 1e9


@pytest.fixture
def out_of_time_after_the_nominal_replay(monkeypatch):
    """A limit, however long it is, is used up when the nominal rig has been replayed: by no clock."""

    def used_up(self, seconds_s):
        self._ends_s, self._reserve_s = time.monotonic() + FOREVER_S, 2 * FOREVER_S

    monkeypatch.setattr(StopSignal, "reserve", used_up)
