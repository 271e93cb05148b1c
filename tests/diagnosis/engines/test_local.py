"""Processes of this machine: the same results, whoever computes them and whoever is lost."""

import os
import signal
from pathlib import Path

import pytest

from diagnosis.engines.engine import EngineFailed, Job
from diagnosis.engines.local import on_this_machine

TASKS = [range(0, 2), range(2, 4), range(4, 6)]
EXPECTED = {task: sum(task) for task in TASKS}


def die_once(mark, task):
    if task.start == 2 and not Path(mark).exists():
        Path(mark).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return sum(task)


def die(task):
    os.kill(os.getpid(), signal.SIGKILL)


def job(function, *arguments):
    return Job(function=f"{__name__}.{function.__name__}", arguments=arguments, noun="cases")


@pytest.mark.parametrize("workers", [1, 2])
def test_results_are_the_same_with_one_worker_and_with_two(workers):
    assert dict(on_this_machine(workers)(Job(function="builtins.sum"), TASKS)) == EXPECTED


def test_a_worker_that_dies_loses_nothing(tmp_path):
    mark = tmp_path / "died"
    assert dict(on_this_machine(2)(job(die_once, str(mark)), TASKS)) == EXPECTED
    assert mark.exists()


def test_a_task_that_kills_every_worker_is_an_error_that_says_what_to_do():
    with pytest.raises(EngineFailed, match=r"cases 0 to 1: .*cases_per_piece"):
        list(on_this_machine(2)(job(die), TASKS))


def test_a_mistake_in_a_job_is_raised():
    with pytest.raises(TypeError):
        list(on_this_machine(2)(Job(function="builtins.sum", arguments=(1, 2, 3)), TASKS))
