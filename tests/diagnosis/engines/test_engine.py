"""A job is the same wherever it is done, or it is refused."""

import subprocess
import sys

import pytest

from diagnosis.engines import engine
from diagnosis.engines.engine import EngineFailed, Job, refuse_more_losses
from models.errors import EnvironmentMismatch

DOUBLED = Job(function="operator.mul", arguments=(2,), noun="number")


def test_a_job_is_its_function_of_arguments_and_task():
    assert DOUBLED(21) == 42


def test_a_worker_that_would_compute_something_else_is_refused(monkeypatch):
    made_here = DOUBLED
    monkeypatch.setattr(engine, "_version", lambda name: "0.0.0")
    with pytest.raises(EnvironmentMismatch, match="same versions"):
        made_here(21)


def test_who_hands_jobs_on_does_not_load_what_they_need():
    """The scheduler of a cluster would be deaf meanwhile."""
    loaded = "import sys, diagnosis.engines.engine; print({'mujoco', 'numpy'} & set(sys.modules))"
    shown = subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True, check=True)
    assert shown.stdout.strip() == "set()"


def test_tasks_are_named_as_people_say_them():
    assert DOUBLED.about(range(4, 6)) == "number 4 to 5"
    assert DOUBLED.about("case_001") == "number case_001"


def test_three_losses_without_a_result_are_no_accident():
    refuse_more_losses(DOUBLED, 2, ["one"])
    with pytest.raises(EngineFailed, match=r"number one: .*cases_per_piece"):
        refuse_more_losses(DOUBLED, 3, ["one"])
