"""What is told of a diagnosis that runs."""

import pytest

from diagnosis import progress as module
from diagnosis.progress import Progress, ProgressClock
from diagnosis.stopping import StopSignal


@pytest.fixture
def told(monkeypatch):
    """What a clock tells of stages, each heard at a time."""
    now = [0.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])

    def tell(*heard, limit_s=None):
        now[0], found = 0.0, list[Progress]()
        clock = ProgressClock(found.append, StopSignal(limit_s))
        for at_s, stage, done, tasks in heard:
            now[0] = at_s
            clock.heard(stage, done, tasks)
        return found

    return tell


def test_a_stage_is_told_in_words_with_its_tasks_and_the_time(told):
    (news,) = told((2.0, "single effects", 3, 4))
    assert (news.stage, news.done, news.tasks) == ("fitting single effects", 3, 4)
    assert news.elapsed_s == 2.0


def test_a_stage_with_nothing_to_do_is_not_told(told):
    assert told((2.0, "pairs", 0, 0)) == []


def test_at_the_beginning_nobody_knows_what_is_left(told):
    (news,) = told((2.0, "nominal rig", 0, 1))
    assert news.left_s is None


def test_what_is_left_lies_between_what_few_and_what_many_stages_take(told):
    *_, news = told((0.0, "single effects", 0, 8), (2.0, "single effects", 8, 8))
    least_s, most_s = news.left_s
    assert 0 < least_s < most_s


def test_no_more_is_left_than_the_limit_leaves(told):
    begun = (0.0, "single effects", 0, 8)
    first, later, last = told(begun, (30.0, "single effects", 8, 8), (40.0, "pairs", 0, 1), limit_s=35.0)
    assert first.left_s == pytest.approx((0.0, 35.0))
    assert later.left_s == pytest.approx((5.0, 5.0))
    assert last.left_s == (0.0, 0.0)
