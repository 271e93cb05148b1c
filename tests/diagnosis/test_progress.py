"""Stages in words, and the time that is left."""

import pytest

from diagnosis import progress as module
from diagnosis.progress import Progress, ProgressClock, in_words
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


def test_a_stage_that_is_not_known_is_told_as_it_is(told):
    assert in_words("another stage") == "another stage"
    (news,) = told((2.0, "another stage", 0, 1))
    assert news.left_s is None


def test_what_is_left_goes_by_the_pace_so_far(told):
    """Half as fast from the beginning: twice as much is left."""
    slow, fast = (told((at_s, "screening pairs", 0, 10))[0].left_s for at_s in (20.0, 10.0))
    assert slow == pytest.approx(2 * fast)
    assert fast > 0


def test_stages_that_are_skipped_count_as_passed(told):
    before, after = told((10.0, "screening pairs", 0, 10), (10.0, "detection limits", 0, 10))
    assert after.left_s < before.left_s


def test_at_the_end_nothing_is_left(told):
    assert told((10.0, "detection limits", 5, 5))[0].left_s == pytest.approx(0.0)


@pytest.mark.parametrize("stage", ["mesh refinement", "three effects", "screening free-form laws"])
def test_of_a_stage_that_few_logs_need_nobody_knows_when_it_ends(told, stage):
    """Once it has ended, its time says nothing of the pace of the others."""
    before, within, still, after = told(
        (10.0, "pairs", 1, 2), (10.0, stage, 0, 2), (50.0, stage, 1, 2), (90.0, "pairs", 1, 2)
    )
    assert (within.left_s, still.left_s) == (None, None)
    assert after.left_s == pytest.approx(before.left_s)
    assert told((10.0, stage, 0, 2), limit_s=35.0)[0].left_s == pytest.approx(25.0)


def test_no_more_is_left_than_the_limit_leaves(told):
    first, later = told((0.1, "nominal rig", 0, 1), (30.0, "pairs", 0, 1), limit_s=35.0)
    assert first.left_s == pytest.approx(34.9)
    assert later.left_s == pytest.approx(5.0)
    assert told((40.0, "pairs", 0, 1), limit_s=35.0)[0].left_s == 0.0
