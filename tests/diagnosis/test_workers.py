"""Every call comes back, in order, as a value or as a failure that names its effects."""

import os
import signal
import time
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from multiprocessing import active_children
from threading import Event, Timer

import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from diagnosis.stopping import StopReason, StopSignal, raise_if_stopped
from diagnosis.workers import Failure, Task, Workers, attempt, process_pool
from models.errors import InvalidValue
from sim.needles.run import SimulationFailed


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


def threads_of_libraries():
    """Of linear algebra, in the process that is asked: the most that any library uses."""
    return max(library["num_threads"] for library in threadpool_info())


def test_libraries_use_one_thread_in_each_process_however_many_they_have_outside():
    """In this one, too: its threads would wait for the workers on every small product."""
    asked = [Task(effects=(), arguments=()) for _ in range(4)]
    with threadpool_limits(2):
        with process_pool(2) as two:
            assert threads_of_libraries() == 1
            assert two.each("", threads_of_libraries, asked) == [1] * 4
        assert threads_of_libraries() == 2


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


def test_progress_is_told_before_and_after_every_task():
    told = []
    Workers(progress=lambda *news: told.append(news)).each("fitting", work, TASKS)
    assert told == [("fitting", done, 4) for done in range(5)]


def test_progress_of_several_processes_ends_with_all_tasks(pool):
    told = []
    replace(pool, progress=lambda *news: told.append(news)).each("fitting", work, TASKS)
    counts = [done for _, done, _ in told]
    assert counts == sorted(counts)
    assert told[-1] == ("fitting", 4, 4)


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
    # What runs is killed, what waits is dropped; not all of 40 x 0.5 s / 2.
    assert time.perf_counter() - start < 5.0


def test_after_a_stop_no_task_is_begun_in_this_process():
    stop, begun = StopSignal(), []

    def last(value):
        begun.append(value)
        stop.request(StopReason.INTERRUPTED)
        return value

    found = Workers(stop=stop).each("fitting", last, TASKS)
    assert (begun, found[0]) == ([0], 0)
    assert all(failure.stopped for failure in found[1:])
    assert [failure.effects for failure in found[1:]] == [task.effects for task in TASKS[1:]]
    assert stop.left_out == ["fitting"]


def long(seconds_s):
    """A task that looks at no signal."""
    time.sleep(seconds_s)
    return seconds_s


def test_after_a_stop_what_runs_in_other_processes_is_not_waited_for():
    stop = StopSignal(0.5)
    tasks = [Task(effects=(str(s),), arguments=(s,)) for s in (0.0, 60.0, 60.0, 60.0)]
    start = time.perf_counter()
    with process_pool(2, stop=stop) as two:
        found = two.each("fitting", long, tasks)
    assert time.perf_counter() - start < 30.0
    assert found[0] == 0.0
    assert [failure.stopped for failure in found[1:]] == [True] * 3
    assert stop.left_out == ["fitting"]


def until_stopped(steps):
    """A fit: it looks at the signal between its steps."""
    for _ in range(steps):
        raise_if_stopped()
        time.sleep(0.01)
    return steps


def test_a_stop_reaches_what_runs_in_another_process():
    """Both tasks would take ten minutes."""
    stop = StopSignal()
    with process_pool(2, stop=stop) as two:
        task = Task(effects=(), arguments=(60_000,))
        running = [two.pool.submit(attempt, until_stopped, task) for _ in range(2)]
        stop.request(StopReason.INTERRUPTED)
        assert all(call.result(timeout=30.0).stopped for call in running)


def within(seconds_s, condition):
    """Whether a condition comes true: a process that ended is noticed a moment later."""
    ends_s = time.perf_counter() + seconds_s
    while not (true := condition()) and time.perf_counter() < ends_s:
        time.sleep(0.01)
    return true


def test_processes_end_with_their_pool():
    others = active_children()
    with process_pool(2) as two:
        two.each("", long, [Task(effects=(), arguments=(0.0,))])
        ours = [process for process in active_children() if process not in others]
        assert len(ours) == 2
        two.pool.submit(long, 60.0)
    assert within(5.0, lambda: not any(process.is_alive() for process in ours))


def killed(seconds_s):
    """A process that the system takes away, as it does where memory runs out; or one that is busy."""
    time.sleep(seconds_s)
    if not seconds_s:
        os.kill(os.getpid(), signal.SIGKILL)


def test_a_process_that_is_lost_is_an_error_and_the_others_end_too():
    """The other one is busy and hears no signal but that which nobody can ignore."""
    others = set(active_children())  # a list of them comes in any order
    tasks = [Task(effects=(), arguments=(seconds_s,)) for seconds_s in (60.0, 0.0)]
    start = time.perf_counter()
    with pytest.raises(BrokenProcessPool), process_pool(2) as two:
        two.each("", killed, tasks)
    assert time.perf_counter() - start < 30.0
    assert within(5.0, lambda: others.issuperset(active_children()))


@pytest.mark.parametrize("count", [1, 2])
def test_what_is_begun_ends_when_its_value_is_asked_for(count):
    with process_pool(count) as workers:
        good, bad = workers.begin(work, 2), workers.begin(misuse, 2)
        assert good() == 20
        with pytest.raises(InvalidValue):
            bad()


def test_what_is_called_meanwhile_is_done_here_when_the_processes_have_ended():
    done = []
    with process_pool(2, meanwhile=lambda: done.append(os.getpid())) as pool:
        others = pool.each("x", os.getpid, [Task(effects=(), arguments=())])
    assert done == [os.getpid()]
    assert os.getpid() not in others


def test_errors_of_what_is_called_meanwhile_are_ignored(capfd):
    with process_pool(2, meanwhile=lambda: misuse(1)) as pool:
        assert pool.each("x", work, TASKS) == EXPECTED
    assert capfd.readouterr().err == ""


def test_without_a_call_to_the_processes_nothing_is_called_meanwhile():
    """Their first call forks them, and they would share the locks of a thread that began before."""
    done = []
    with process_pool(2, meanwhile=lambda: done.append(1)):
        pass
    assert done == []


def test_who_interrupts_the_wait_for_what_is_called_meanwhile_leaves_no_process():
    """Else the end of this process would wait for them for ever."""
    before, waited_for, handler = active_children(), Event(), signal.getsignal(signal.SIGINT)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    interrupt = Timer(0.5, os.kill, args=(os.getpid(), signal.SIGINT))
    try:
        with pytest.raises(KeyboardInterrupt), process_pool(2, meanwhile=waited_for.wait) as pool:
            pool.each("x", os.getpid, [Task(effects=(), arguments=())])
            interrupt.start()
        assert [process for process in active_children() if process not in before] == []
    finally:
        waited_for.set()
        signal.signal(signal.SIGINT, handler)
