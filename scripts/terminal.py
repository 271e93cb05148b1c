"""The consoles of the command, which show the user's text literally.

Rich interprets markup in text (`[bold]`, `:bomb:`), and a terminal control characters (27). Names,
descriptions and paths of users may contain both: no text is interpreted here, and styles are
`rich.text.Text`.
"""

import errno
import os
from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from models.user_text import printable


class Terminal(Console):
    """A console that shows text literally, with a mark for characters that cannot be shown.

    A closed pipe raises an error, instead of ending the process.
    """

    def on_broken_pipe(self) -> None:
        """Called by rich on a closed pipe; rich's own method ends the process.

        Raises:
          BrokenPipeError: always.
        """
        raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Segments of the output; only rich's own may be control codes."""
        for text, style, control in super().render(renderable, options):
            yield Segment(text if control else printable(text), style, control)


def terminal(*, stderr: bool = False) -> Terminal:
    """The console for results, or for errors and progress."""
    return Terminal(stderr=stderr, markup=False, emoji=False)
