"""The entry point of the installed command `needle`, in a package with a unique name.

Other projects use the same package names as this one. A folder `models/` or `scripts/` on PYTHONPATH (an
empty entry is the current folder), or one of another installed project, would be found first. So this
module loads our packages from its own location before anything else imports them. New worker processes
(spawn, forkserver) import this module first, like the command.
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
