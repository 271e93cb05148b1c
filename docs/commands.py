"""Every command and option of `needle` in Markdown, from its parser."""

import argparse
from collections.abc import Iterator


def commands_page(parser: argparse.ArgumentParser) -> str:
    """A section per command, after that of the program itself: what it does, its arguments."""
    whole = ("needle", (parser.description or "").rstrip("."), parser)
    return "\n".join(_section(name, about, one) for name, about, one in (whole, *_commands(parser)))


def _commands(
    parser: argparse.ArgumentParser, before: str = "needle"
) -> Iterator[tuple[str, str, argparse.ArgumentParser]]:
    """Name, help and parser of each command that does something: those of `needle blind`, not itself."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            about = {choice.dest: choice.help or "" for choice in action._choices_actions}
            for name, one in action.choices.items():
                inner = [*_commands(one, f"{before} {name}")]
                yield from inner or [(f"{before} {name}", about.get(name, ""), one)]


def _section(name: str, about: str, parser: argparse.ArgumentParser) -> str:
    left_out = (argparse._HelpAction, argparse._SubParsersAction)
    arguments = [a for a in parser._actions if not isinstance(a, left_out)]
    rows = [f"| {_written(a)} | {_cell(a.help or '')} |" for a in arguments]
    table = ["| argument | meaning |", "|---|---|", *rows] if rows else []
    return "\n".join([f"## {name}", "", f"{about[:1].upper()}{about[1:]}.", "", *table, ""])


def _written(action: argparse.Action) -> str:
    """As it is written on a command line."""
    if not action.option_strings:
        return f"`{action.metavar or action.dest}`"
    value = "" if action.nargs == 0 else f" {_value(action)}"
    return ", ".join(f"`{option}{value}`" for option in action.option_strings)


def _value(action: argparse.Action) -> str:
    given = action.metavar or action.dest.upper()
    return given if isinstance(given, str) else " ".join(given)


def _cell(text: str) -> str:
    return text.replace("%%", "%").replace("|", "\\|")
