"""Where the installed command `needle` begins, under a name of its own: `needle_torsion_console`.

Our packages have names that others use too. A folder `models/` or `scripts/` on PYTHONPATH (an empty
entry there is the current folder), or one that another project left among the installed packages, would
be found before ours. So ours are loaded here, from beside this package, before anything else asks for
them. Worker processes that start anew (spawn, forkserver) import this module first, like the command.
"""

import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

PACKAGES = ("models", "sim", "controllers", "diagnosis", "studies", "validation", "scripts")


def _load_ours() -> None:
    beside = next(p for p in Path(__file__).parents if (p / "scripts" / "main.py").is_file())
    sys.path.insert(0, str(beside))
    try:
        for name in PACKAGES:
            import_module(name)
    finally:
        sys.path.remove(str(beside))


_load_ours()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a subcommand; returns the exit code (see `scripts.main`)."""
    from scripts.main import main as command

    return command(arguments)
