"""What engines have in common: a job, its tasks, and when they give up.

A job names its function instead of holding it, so that only workers import it: the scheduler of a
cluster imports nothing but this module.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from typing import Any, Protocol, TypeVar

from models.errors import EnvironmentMismatch, NeedleError

Plain = str | int | float | bool | None
Task = TypeVar("Task", range, str)
"""Numbers of cases, or the name of one thing."""

MOST_LOSSES = 3  # of workers in a row, without a result in between: it is no accident
_DECIDE = ("needle-torsion", "mujoco")  # distributions on whose versions results depend


class EngineFailed(NeedleError):
    """No worker is left that could compute."""


def _versions() -> tuple[str, ...]:
    """Versions of the installed packages that results depend on."""
    return tuple(f"{name} {_version(name)}" for name in _DECIDE)


@cache
def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "from its source"


@dataclass(frozen=True, kw_only=True)
class Job:
    """A function to call with each task, with the same result on any worker.

    Attributes:
      function: as `package.module.name`; called with the arguments and the task.
      noun: word for a task in messages.
      versions: versions of packages in the process that made the job.
    """

    function: str
    arguments: tuple[Plain, ...] = ()
    noun: str = "task"
    versions: tuple[str, ...] = field(default_factory=_versions)

    def __call__(self, task: Task) -> Any:
        """The result of a task.

        Raises:
          EnvironmentMismatch: other versions are installed here, so that results could differ.
        """
        if self.versions != _versions():
            raise EnvironmentMismatch(
                f"expected {', '.join(self.versions)}, as on the machine of the command, found "
                f"{', '.join(_versions())} on the worker: install the same versions on both"
            )
        module, _, name = self.function.rpartition(".")
        return getattr(import_module(module), name)(*self.arguments, task)

    def about(self, task: Task) -> str:
        """A task in words, for messages."""
        named = f"{task.start} to {task.stop - 1}" if isinstance(task, range) else task
        return f"{self.noun} {named}"


class Engine(Protocol):
    """Computes the tasks of a job."""

    def __call__(self, job: Job, tasks: Sequence[Task]) -> Iterator[tuple[Task, Any]]:
        """Each task with its result, as soon as it is done, in any order."""
        ...


def refuse_more_losses(job: Job, losses: int, missing: Sequence[Task]) -> None:
    """Give up if workers die repeatedly.

    Raises:
      EngineFailed: names a task that is missing.
    """
    if losses >= MOST_LOSSES:
        raise EngineFailed(
            f"workers died {losses} times without completing anything, among them with"
            f" {job.about(missing[0])}: check whether they ran out of memory, or use smaller pieces"
            " (cases_per_piece of a campaign) or fewer workers; completed work is kept: run the command"
            " again (a campaign with --resume)"
        )
