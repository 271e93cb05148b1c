"""Progress on the screen: one line that changes on a terminal, plain lines in a file or a pipe."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import Progress as Bar
from rich.progress import SpinnerColumn, TextColumn, TimeElapsedColumn

from diagnosis.progress import Progress
from diagnosis.stopping import StopSignal

_LINE_EVERY_S = 5.0
Shown = Callable[[Progress], None]


@contextmanager
def progress_line(console: Console, stop: StopSignal) -> Iterator[Shown]:
    """What shows progress while the block runs."""
    if not console.is_terminal or console.is_dumb_terminal:
        yield _lines(console, stop)
        return
    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Bar(*columns, console=console, transient=True) as bar:
        task = bar.add_task("", total=None)
        yield lambda news: bar.update(task, description=in_one_line(news, stop))


def _lines(console: Console, stop: StopSignal) -> Shown:
    """A line for every stage, and for every five seconds of one."""
    last: list[Progress] = []

    def shown(news: Progress) -> None:
        same = last and last[0].stage == news.stage
        if same and news.elapsed_s - last[0].elapsed_s < _LINE_EVERY_S:
            return
        last[:] = [news]
        line = f"{news.elapsed_s:5.0f} s  {in_one_line(news, stop)}"
        console.print(line, highlight=False, markup=False, soft_wrap=True)

    return shown


def in_one_line(news: Progress, stop: StopSignal) -> str:
    """Stage, tasks, and an estimate of the time that is left, called one."""
    stopping = "stopping (again: at once), " if stop.requested else ""
    tasks = f", {news.done} of {news.tasks}" if news.tasks > 1 else ""
    left = "" if news.left_s is None else f"; about {news.left_s:.0f} s left"
    return f"{stopping}{news.stage}{tasks}{left}"
