"""A signal to stop: by its limit, or because somebody asks."""

import math
import time

import pytest

from diagnosis.stopping import (
    NEVER,
    StoppedEarly,
    StopReason,
    StopSignal,
    listening,
    raise_if_stopped,
    stopping,
)
from models.errors import InvalidValue

NOW = time.monotonic


def past(limit_s=5.0, reserve_s=0.0, ago_s=6.0):
    """A signal whose limit counts from a while ago."""
    return StopSignal(limit_s, began_s=NOW() - ago_s, reserve_s=reserve_s)


def test_without_a_limit_nothing_is_due():
    assert not StopSignal().due
    assert not NEVER.due


def test_a_limit_is_due_once_it_is_past():
    assert past().due
    assert not past(limit_s=60.0).due
    assert past().why == "limit of 5 s"


def test_what_is_kept_for_the_end_comes_off_the_limit():
    stop = past(limit_s=20.0, reserve_s=10.0)
    assert not stop.due
    stop.reserve(5.0)
    assert stop.due
    assert not stop.over


@pytest.mark.parametrize(
    ("reason", "why"),
    [(StopReason.INTERRUPTED, "interrupted"), (StopReason.TERMINATED, "terminated")],
)
def test_a_request_is_due_at_once(reason, why):
    stop = StopSignal()
    stop.request(reason)
    assert stop.due
    assert stop.over
    assert (stop.why, stop.requested) == (why, reason)


@pytest.mark.parametrize("limit_s", [0.0, -1.0, math.nan, math.inf])
def test_a_limit_that_is_no_time_is_refused(limit_s):
    with pytest.raises(InvalidValue, match="limit: expected seconds above 0"):
        StopSignal(limit_s)


def test_only_what_listens_is_stopped():
    raise_if_stopped()
    with listening(past()):
        assert stopping()
        with pytest.raises(StoppedEarly, match="limit of 5 s"):
            raise_if_stopped()
        with listening(NEVER):
            raise_if_stopped()
    assert not stopping()


def test_a_part_without_time_is_left_out():
    stop = past()
    assert stop.unless_due("limits", pytest.fail) is None
    assert stop.left_out == ["limits"]


def test_a_part_that_a_stop_cuts_short_is_left_out_too():
    stop = StopSignal()
    assert stop.unless_due("interval", lambda: 3) == 3
    assert stop.left_out == []
    assert stop.unless_due("limits", lambda: stop.request(StopReason.INTERRUPTED) or {}) is None
    assert stop.left_out == ["limits"]


def test_a_part_is_noted_once():
    stop = StopSignal()
    for part in ("pairs", "limits", "pairs"):
        stop.leave_out(part)
    assert stop.left_out == ["pairs", "limits"]
