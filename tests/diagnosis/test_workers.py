"""Every call comes back, in order, as a value or as a failure that names its effects."""

import threading
import time

import pytest

from diagnosis.workers import Failure, Task, Workers, attempt, process_pool, side_by_side
from models.errors import InvalidValue
from sim.simulation import SimulationFailed


def work(value):
    """Slow for the first, so that others end before it; some cannot be simulated."""
    time.sleep(0.2 if value == 0 else 0.0)
    if value % 2:
        raise SimulationFailed(f"no numbers for {value}")
    return 10 * value


def misuse(value):
    """A call that is wrong."""
    raise InvalidValue("value", value, "something else", "take another")


TASKS = [Task(effects=("tip_drag", str(i)), arguments=(i,)) for i in range(4)]
EXPECTED = [
    0,
    Failure(effects=("tip_drag", "1"), reason="no numbers for 1"),
    20,
    Failure(effects=("tip_drag", "3"), reason="no numbers for 3"),
]


@pytest.fixture(scope="module")
def pool():
    with process_pool(2) as two:
        yield two


def test_a_call_is_its_value_or_a_failure_that_names_the_effects():
    assert [attempt(work, task) for task in TASKS] == EXPECTED


def test_this_process_gives_every_result_in_the_order_of_the_tasks():
    with process_pool(1) as alone:
        assert alone.pool is None
        assert alone.each("", work, TASKS) == EXPECTED


def test_several_processes_give_the_same_in_the_same_order(pool):
    assert pool.pool is not None
    assert pool.each("", work, TASKS) == EXPECTED


def test_no_task_is_no_result(pool):
    assert pool.each("", work, []) == []


def test_progress_is_told_after_every_task():
    told = []
    Workers(progress=lambda *news: told.append(news)).each("fitting", work, TASKS)
    assert told == [("fitting", share) for share in (0.25, 0.5, 0.75, 1.0)]


def test_misuse_is_raised_as_what_it_is():
    with pytest.raises(InvalidValue, match="something else"):
        Workers().each("", misuse, TASKS)


def test_misuse_is_raised_from_another_process_as_what_it_is(pool):
    with pytest.raises(InvalidValue) as caught:
        pool.each("", misuse, TASKS)
    assert caught.value.field == "value"
    assert caught.value.fix == "take another"
    assert str(caught.value) == str(InvalidValue("value", 0, "something else", "take another"))


def test_what_was_submitted_is_dropped_when_the_user_interrupts():
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt), process_pool(2) as two:
        for _ in range(40):
            two.pool.submit(time.sleep, 0.5)
        raise KeyboardInterrupt
    # What runs or is queued for the two processes ends; not all of 40 x 0.5 s / 2.
    assert time.perf_counter() - start < 5.0


def threads_used(_):
    """On how many threads three items at once run, seen from within a call."""
    together = threading.Barrier(3, timeout=1.0)

    def meets(_):
        try:
            together.wait()
        except threading.BrokenBarrierError:
            return False
        return True

    return all(side_by_side(meets, range(3)))


def test_cores_that_fewer_calls_leave_go_to_threads():
    with process_pool(3) as three:
        one, two = ([Task(effects=(), arguments=(i,)) for i in range(n)] for n in (1, 2))
        assert three.each("", threads_used, one) == [True]
        assert three.each("", threads_used, two) == [False, False]
        assert threads_used(None)  # this process waits for nobody then
    assert not threads_used(None)


def test_side_by_side_is_in_order_and_raises_what_the_first_item_raises():
    with process_pool(2):
        assert side_by_side(work, [0, 2, 4]) == [0, 20, 40]
        with pytest.raises(SimulationFailed, match="for 1"):
            side_by_side(work, [0, 1, 2, 3])
