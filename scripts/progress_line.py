"""Progress on the screen: one line that changes on a terminal, plain lines in a file or a pipe."""

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import TypeVar

from rich.console import Console
from rich.progress import Progress as Bar
from rich.progress import SpinnerColumn, TextColumn, TimeElapsedColumn

from diagnosis.progress import Progress
from diagnosis.stopping import NEVER, StopSignal
from diagnosis.workers import Heard
from scripts.terminal import terminal

T = TypeVar("T")
Shown = Callable[[Progress], None]
ByShare = Callable[[str, float], None]

_LINE_EVERY_S = 5.0
_ALIKE = 1.2  # most over least time left, below which one number tells both
_LEAST_SHARE = 0.03  # before which the pace says nothing


@contextmanager
def progress_line(console: Console, stop: StopSignal = NEVER) -> Iterator[Shown]:
    """What shows progress while the block runs."""
    if not console.is_terminal or console.is_dumb_terminal:
        yield _lines(console, stop)
        return
    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Bar(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=None)
        yield lambda news: bar.update(task, description=in_one_line(news, stop))


@contextmanager
def stage_line() -> Iterator[ByShare]:
    """What shows, beside the results, a stage in words and the share of the whole that is done."""
    with progress_line(terminal(stderr=True)) as show:
        yield by_share(show)


def by_share(show: Shown) -> ByShare:
    """Progress from stages and shares: the pace so far gives the time that is left."""
    began_s = time.monotonic()

    def heard(stage: str, share: float) -> None:
        show(_progress(stage, share, time.monotonic() - began_s))

    return heard


def within(heard: ByShare, begins: float, ends: float = 1.0) -> ByShare:
    """Who hears shares of a part of the whole, where that part takes from one share to another."""
    return lambda stage, share: heard(stage, begins + (ends - begins) * share)


def unheard(stage: str, share: float) -> None:
    """Stages and shares that nobody listens to."""


def by_count(show: Shown) -> Heard:
    """Progress from a stage and its tasks, done and all."""
    began_s = time.monotonic()

    def heard(stage: str, done: int, tasks: int) -> None:
        elapsed_s = time.monotonic() - began_s
        show(_progress(stage, done / max(tasks, 1), elapsed_s, done=done, tasks=tasks))

    return heard


def counted(items: Iterable[T], total: int, stage: str, show: Shown) -> Iterator[T]:
    """Items as they come, each of which is a task of one stage."""
    heard = by_count(show)
    heard(stage, 0, total)
    for done, item in enumerate(items, start=1):
        yield item
        heard(stage, done, total)


def _progress(stage: str, share: float, elapsed_s: float, *, done: int = 0, tasks: int = 1) -> Progress:
    known = share >= _LEAST_SHARE
    left_s = elapsed_s * (1.0 - share) / share if known else 0.0
    both = (left_s, left_s) if known else None
    return Progress(stage=stage, done=done, tasks=tasks, elapsed_s=elapsed_s, left_s=both)


def _lines(console: Console, stop: StopSignal) -> Shown:
    """A line for every stage, and for every five seconds of one."""
    last: list[Progress] = []

    def shown(news: Progress) -> None:
        same = last and last[0].stage == news.stage
        if same and news.elapsed_s - last[0].elapsed_s < _LINE_EVERY_S:
            return
        last[:] = [news]
        line = f"{news.elapsed_s:5.0f} s  {in_one_line(news, stop)}"
        with suppress(OSError):  # results do not depend on who hears of them
            console.print(line, highlight=False, markup=False, soft_wrap=True)

    return shown


def in_one_line(news: Progress, stop: StopSignal) -> str:
    """Stage, tasks, and an estimate of the time that is left, called one."""
    stopping = "stopping (once more: at once), " if stop.requested else ""
    tasks = f", {news.done} of {news.tasks}" if news.tasks > 1 else ""
    left = "" if news.left_s is None else f"; {_left_in_words(*news.left_s)} left"
    return f"{stopping}{news.stage}{tasks}{left}"


def _left_in_words(least_s: float, most_s: float) -> str:
    """An estimate, or two where it is open what is still to do, with two digits."""
    least, most = (f"{float(f'{value:.2g}'):.0f}" for value in (least_s, most_s))
    if most_s <= _ALIKE * least_s or least == most:
        return f"about {most} s"
    return f"at most {most} s" if least == "0" else f"{least} to {most} s"
