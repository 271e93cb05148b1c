"""Signals to the command: once asks for the best so far, twice ends it."""

import multiprocessing
import signal
import threading

import pytest

from diagnosis.stopping import StopReason, StopSignal
from scripts.stop_signals import EXIT_CODES, stops_on_signals


@pytest.mark.parametrize(
    ("number", "reason", "code"),
    [(signal.SIGINT, StopReason.INTERRUPTED, 130), (signal.SIGTERM, StopReason.TERMINATED, 143)],
)
def test_a_signal_asks_for_the_best_so_far(number, reason, code):
    stop = StopSignal()
    with stops_on_signals(stop):
        signal.raise_signal(number)
    assert stop.requested is reason
    assert EXIT_CODES[stop.requested] == code


@pytest.mark.parametrize("first", [signal.SIGINT, signal.SIGTERM])
def test_a_second_interrupt_ends_it(first):
    with pytest.raises(KeyboardInterrupt), stops_on_signals(StopSignal()):
        signal.raise_signal(first)
        signal.raise_signal(signal.SIGINT)


def test_a_second_sigterm_ends_it_with_its_own_code():
    with pytest.raises(SystemExit) as ended, stops_on_signals(StopSignal()):
        signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGTERM)
    assert ended.value.code == 143


def test_handlers_are_as_before_afterwards():
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.getsignal(number) for number in numbers]
    with stops_on_signals(StopSignal()):
        assert [signal.getsignal(number) for number in numbers] != before
    assert [signal.getsignal(number) for number in numbers] == before


def test_another_thread_hears_of_no_signals():
    """Only the main thread may say who handles them."""
    ran = []

    def inside():
        with stops_on_signals(StopSignal()):
            ran.append(True)

    thread = threading.Thread(target=inside)
    thread.start()
    thread.join()
    assert ran == [True]


def test_without_a_signal_the_exit_code_is_0():
    assert EXIT_CODES[StopSignal().requested] == 0


def test_a_process_that_was_just_made_leaves_signals_to_its_parent():
    """It has the parent's handlers until it sets its own; both share what was asked for."""
    stop = StopSignal()
    with stops_on_signals(stop):
        child = multiprocessing.get_context("fork").Process(
            target=signal.raise_signal, args=(signal.SIGTERM,)
        )
        child.start()
        child.join()
    assert child.exitcode == 0
    assert stop.requested is StopReason.NOBODY
