"""`needle completion`: a script that completes arguments, options and names in bash or zsh."""

import argparse
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from rich.console import Console

from scripts.arguments import parser
from scripts.blind import KNOWN_NAMES
from sim.paper_protocols import PROTOCOLS
from studies.control.tip_controllers import TIP_CONTROLLERS

_NAMES: Mapping[str, Iterable[str]] = {
    "protocol": PROTOCOLS,
    "controller": TIP_CONTROLLERS,
    **KNOWN_NAMES,
}
_FOLDERS = ("DIR", "LOG")


def run(shell: str, console: Console) -> int:
    """Print the script unchanged: rich would replace its tabs by blanks."""
    console.file.write(script(shell))
    return 0


def script(shell: str) -> str:
    """The script of a shell, `bash` or `zsh`."""
    import shtab  # needed here alone

    top = parser()
    for action in _actions(top):
        if action.type is Path:
            complete = shtab.DIRECTORY if action.metavar in _FOLDERS else shtab.FILE
            vars(action)["complete"] = complete
        elif action.dest in _NAMES:
            action.choices = list(_NAMES[action.dest])
    made: str = shtab.complete(top, shell)
    return made.rstrip("\n") + "\n"


def _actions(of: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Every argument, including those of subcommands."""
    for action in of._actions:
        yield action
        if isinstance(action.choices, Mapping):
            for subcommand in action.choices.values():
                yield from _actions(subcommand)
