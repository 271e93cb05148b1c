"""The consoles of the command: what a user wrote is shown as it stands.

Rich reads marks in text (`[bold]`, `:bomb:`), and a terminal reads controls (character 27). Names,
descriptions and paths of users may hold both: no text is read here, style comes as `rich.text.Text`.
"""

import errno
import os
from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from models.user_text import printable


class Terminal(Console):
    """A console that shows text as it stands, with a mark for what cannot be shown.

    A pipe that somebody closed is an error like others, and not an exit.
    """

    def on_broken_pipe(self) -> None:
        """Called by rich, which would end the process.

        Raises:
          BrokenPipeError: always.
        """
        raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Segments of what is printed; only rich's own are controls."""
        for text, style, control in super().render(renderable, options):
            yield Segment(text if control else printable(text), style, control)


def terminal(*, stderr: bool = False) -> Terminal:
    """The console for results, or for errors and progress."""
    return Terminal(stderr=stderr, markup=False, emoji=False)
