"""Progress on the screen: one line on a terminal, plain lines elsewhere."""

import io

import pytest
from rich.console import Console

from diagnosis.progress import Progress
from diagnosis.stopping import StopReason, StopSignal
from scripts import progress_line as module
from scripts.progress_line import by_share, counted, in_one_line, progress_line, within


def news(stage="fitting pairs", elapsed_s=1.0, done=3, tasks=20, left_s=(15.4, 15.4)):
    return Progress(stage=stage, done=done, tasks=tasks, elapsed_s=elapsed_s, left_s=left_s)


def shown(*each, **options):
    """What a console of these options shows of progress."""
    screen = io.StringIO()
    with progress_line(Console(file=screen, width=60, **options), StopSignal()) as show:
        for one in each:
            show(one)
    return screen.getvalue()


def test_a_line_has_the_stage_its_tasks_and_an_estimate_that_is_called_one():
    assert in_one_line(news(), StopSignal()) == "fitting pairs, 3 of 20; about 15 s left"


@pytest.mark.parametrize(
    ("told", "line"),
    [
        ({"tasks": 1, "done": 0}, "fitting pairs; about 15 s left"),
        ({"left_s": None}, "fitting pairs, 3 of 20"),
        ({"left_s": (5.2, 63.8)}, "fitting pairs, 3 of 20; 5 to 64 s left"),
        ({"left_s": (10.4, 128.0)}, "fitting pairs, 3 of 20; 10 to 130 s left"),
        ({"left_s": (10.0, 11.9)}, "fitting pairs, 3 of 20; about 12 s left"),
        ({"left_s": (0.2, 9.0)}, "fitting pairs, 3 of 20; at most 9 s left"),
        ({"left_s": (0.0, 0.0)}, "fitting pairs, 3 of 20; about 0 s left"),
    ],
)
def test_a_line_tells_nothing_that_is_not_known(told, line):
    assert in_one_line(news(**told), StopSignal()) == line


def test_a_line_says_that_an_end_was_asked_for():
    stop = StopSignal()
    stop.request(StopReason.INTERRUPTED)
    assert in_one_line(news(), stop).startswith("stopping (once more: at once), fitting pairs")


def test_off_a_terminal_there_is_a_line_for_each_stage_and_for_five_seconds():
    each = [news("screening", 0.0), news("screening", 4.9), news("screening", 5.1), news("fitting", 5.2)]
    said = [line.split(",")[0].split("  ")[-1] for line in shown(*each).splitlines()]
    assert said == ["screening", "screening", "fitting"]


def test_off_a_terminal_lines_are_plain_and_whole():
    said = shown(news("fitting the best single effects [to] the whole log, and more of that"))
    assert said.count("\n") == 1
    assert "[to] the whole log" in said
    assert not [c for c in said if ord(c) < ord(" ") and c != "\n"]


def test_on_a_terminal_the_line_is_gone_at_the_end():
    said = shown(news(), force_terminal=True)
    assert "fitting pairs, 3 of 20" in said
    assert said.endswith("\x1b[2K")


def test_a_terminal_that_cannot_move_its_cursor_gets_lines():
    said = shown(news(), force_terminal=True, _environ={"TERM": "dumb"})
    assert said == "    1 s  fitting pairs, 3 of 20; about 15 s left\n"


@pytest.fixture
def at(monkeypatch):
    """A clock that stands at the times that it is given, one after the other."""

    def stands(*times_s):
        left = list(times_s)
        monkeypatch.setattr(module.time, "monotonic", lambda: left.pop(0))

    return stands


def test_shares_of_the_whole_give_the_time_that_is_left(at):
    told = []
    at(100.0, 100.0, 130.0)
    heard = by_share(told.append)
    heard("simulating", 0.0)
    heard("drawing", 0.75)
    assert [(one.stage, one.elapsed_s, one.left_s) for one in told] == [
        ("simulating", 0.0, None),
        ("drawing", 30.0, pytest.approx((10.0, 10.0))),
    ]


def test_shares_of_a_part_are_shares_of_the_whole():
    told = []
    part = within(lambda stage, share: told.append((stage, share)), 0.2, 0.6)
    for share in (0.0, 0.5, 1.0):
        part("writing", share)
    assert told == [("writing", pytest.approx(share)) for share in (0.2, 0.4, 0.6)]


def test_counted_items_are_tasks_of_one_stage(at):
    told = []
    at(0.0, 0.0, 2.0, 4.0)
    assert list(counted("ab", 2, "making logs", told.append)) == ["a", "b"]
    assert [(one.done, one.tasks, one.left_s) for one in told] == [
        (0, 2, None),
        (1, 2, (2.0, 2.0)),
        (2, 2, (0.0, 0.0)),
    ]
