"""Threads within calls use the cores that no other process computes on."""

import threading
import time

import pytest

from diagnosis.cores import Cores, computing, sharing, side_by_side
from diagnosis.workers import Task, process_pool
from sim.needles.run import SimulationFailed


def three_at_once(wait_s=0.0):
    """Whether three items run at once, asked from within a call that waits for others first."""
    time.sleep(wait_s)
    together = threading.Barrier(3, timeout=1.0)

    def meets(_):
        try:
            together.wait()
        except threading.BrokenBarrierError:
            return False
        return True

    return all(side_by_side(meets, range(3)))


def test_a_process_alone_has_one_thread():
    assert not three_at_once()


def test_cores_that_no_process_computes_on_are_free():
    cores = Cores(count=3)
    with sharing(cores):
        assert cores.free == 3
        with computing():
            assert cores.free == 2  # as others see it
            assert three_at_once()  # its own is among the three
        assert cores.free == 3


def test_a_core_is_free_again_after_an_error():
    cores = Cores(count=3)
    with pytest.raises(SimulationFailed), sharing(cores), computing():
        raise SimulationFailed("no numbers")
    assert cores.free == 3


def test_there_is_always_one_core():
    cores = Cores(count=1)
    with sharing(cores), computing(), computing():
        assert cores.free == 1


def test_cores_that_fewer_calls_leave_go_to_threads():
    with process_pool(3) as three:
        one = [Task(effects=(), arguments=())]
        two = [Task(effects=(), arguments=(0.5,))] * 2
        assert three.each("", three_at_once, one) == [True]
        assert three.each("", three_at_once, two) == [False, False]
        assert three_at_once()  # this process waits for nobody then
    assert not three_at_once()


def test_a_call_that_others_leave_behind_gets_their_cores():
    with process_pool(3) as three:
        left = [Task(effects=(), arguments=(wait_s,)) for wait_s in (0.0, 0.0, 3.0)]
        assert three.each("", three_at_once, left)[2] is True


def work(value):
    """Slow for the first, so that others end before it; some cannot be simulated."""
    time.sleep(0.2 if value == 0 else 0.0)
    if value % 2:
        raise SimulationFailed(f"no numbers for {value}")
    return 10 * value


def test_side_by_side_is_in_order_and_raises_what_the_first_item_raises():
    with sharing(Cores(count=2)):
        assert side_by_side(work, [0, 2, 4]) == [0, 20, 40]
        with pytest.raises(SimulationFailed, match="for 1"):
            side_by_side(work, [0, 1, 2, 3])
