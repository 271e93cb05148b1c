"""The entry point of the installed command `needle`, in a package with a unique name.

Other projects use the same package names as this one. A folder `models/` or `scripts/` on PYTHONPATH (an
empty entry is the current folder), or one of another installed project, would be found first. So this
module loads our packages from its own location before anything else imports them. New worker processes
(spawn, forkserver) import this module first, like the command.
"""

import sys
from importlib import import_module
from pathlib import Path
from typing import NoReturn

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


def main() -> NoReturn:
    """Run the subcommand of the command line; the process ends with its exit code (`scripts.main`)."""
    from scripts.main import run_process

    run_process()
