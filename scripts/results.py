"""What a command says of the results that it wrote, and the exit code that goes with it."""

from rich.console import Console

from scripts.streams import complain
from sim.files import ResultSet

WITHOUT_ALL = 3
"""Exit code: the numbers are written, a picture, page or recording is not."""


def tell(results: ResultSet, console: Console) -> int:
    """Name every file that is there; on standard error what is not, and why."""
    for path in results.made:
        console.print(f"wrote      {path}", highlight=False, markup=False)
    for path, why in results.left_out.items():
        complain(f"warning: {path} could not be made ({why}); the other results stand without it")
    return WITHOUT_ALL if results.left_out else 0
