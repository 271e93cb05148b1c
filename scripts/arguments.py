"""The arguments of the console command `needle`, and the errors for wrong ones."""

import argparse
import platform
import re
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import Any, NoReturn

from models.suggestion import did_you_mean
from scripts.exit_codes import in_words

PACKAGES = ("needle-torsion", "mujoco", "rerun-sdk")
SHELLS = ("bash", "zsh")


class Parser(argparse.ArgumentParser):
    """A parser whose errors suggest the name that was probably meant."""

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Replaces argparse's own check, whose error lists all choices."""
        if action.choices is not None and value not in action.choices:
            known = [str(choice) for choice in action.choices]
            meant = did_you_mean(value, known)
            what = f"expected one of {', '.join(known)}, found {value!r}"
            raise argparse.ArgumentError(action, f"{what}; {meant}" if meant else what)

    def unknown(self, arguments: Sequence[str]) -> NoReturn:
        """Exit because of arguments that this parser does not have."""
        first = arguments[0].partition("=")[0]
        options = re.findall(r"--[a-z][a-z-]*", self.format_help())
        meant = did_you_mean(first, options) if first.startswith("-") else ""
        self.error(f"unknown argument {first!r}; {meant or f'see {self.prog} --help'}")


def _seconds(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected seconds, as 30, found {text!r}") from None


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """The arguments by name; exits with code 2 if they are wrong."""
    found, unknown = parser().parse_known_args(arguments)
    if unknown:
        found.parser.unknown(unknown)
    return found


def parser() -> Parser:
    """The arguments of every subcommand."""
    top = Parser(
        prog="needle",
        description="A flexible needle twisting in tissue: simulate, check, control, diagnose a rig.",
        epilog=f"exit codes:\n{in_words()}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=versions())
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, words: str) -> Parser:
        return _subcommand(commands, name, words)

    _add_output(
        command("demo", "the main steps once: simulate, cross-check, replay a log, diagnose another"),
        "demo",
    )
    _add_insert(command("insert", "simulate a protocol"))
    command("protocols", "list the protocols that are known by name")
    validate = command("validate", "check the simulation against closed-form solutions")
    _add_output(validate, "validate")
    _add_output(command("control", "estimators and controllers: Tables IV and V"), "control")
    _add_import(command("import", "make a rig-log/1 folder of a lab's own files"))
    replay = command("replay", "replay a rig's log on the nominal needle")
    replay.add_argument("log", type=Path, metavar="LOG", help="a rig-log/1 folder")
    _add_output(replay, "replay")
    _add_diagnose(command("diagnose", "say what a rig has that its model lacks"))
    _add_blind(command("blind", "validate the diagnosis on rigs that it has not seen"))
    _add_campaign(command("campaign", "many runs from one file: sweeps, Monte-Carlo"))
    inspect = command("inspect", "open a recording, or list its content")
    inspect.add_argument("file", type=Path, metavar="FILE.rrd")
    inspect.add_argument("--table", action="store_true", help="print a table; needs no screen")
    completion = command("completion", "print a script that completes arguments in a shell")
    completion.add_argument("shell", choices=SHELLS, metavar="|".join(SHELLS))
    return top


def versions() -> str:
    """Versions of this project, of its main packages, and of Python."""
    return ", ".join((*map(_version, PACKAGES), f"Python {platform.python_version()}"))


def _version(package: str) -> str:
    try:
        return f"{package} {metadata.version(package)}"
    except metadata.PackageNotFoundError:
        return f"{package} (not installed)"


def _subcommand(commands: "argparse._SubParsersAction[Parser]", name: str, words: str) -> Parser:
    made = commands.add_parser(name, help=words, description=words[0].upper() + words[1:] + ".")
    made.set_defaults(parser=made)
    return made


def _add_insert(insert: Parser) -> None:
    insert.add_argument(
        "--protocol", default="insertion", help="a name from `needle protocols`, or a YAML file"
    )
    insert.add_argument(
        "--controller",
        metavar="NAME",
        help="control the tip: the protocol's base angle becomes the reference of the tip angle",
    )
    insert.add_argument("--mjcf", type=Path, metavar="FILE", help="write the model for MuJoCo's viewer")
    insert.add_argument(
        "--model", type=Path, metavar="FILE", help="run a changed model that --mjcf wrote"
    )
    _add_output(insert, "insert")


def _add_import(importer: Parser) -> None:
    importer.add_argument(
        "files", type=Path, nargs="+", metavar="FILE", help="CSV or other text, Parquet, MAT, MCAP"
    )
    importer.add_argument(
        "--map", type=Path, metavar="FILE", help="a mapping.yaml; without it one is drafted"
    )
    importer.add_argument(
        "--accept-guesses", action="store_true", help="treat all guesses of the mapping as confirmed"
    )
    _add_output(importer, "import")


def _add_diagnose(diagnose: Parser) -> None:
    diagnose.add_argument("log", type=Path, metavar="LOG", nargs="?", help="a rig-log/1 folder")
    diagnose.add_argument(
        "--paper", action="store_true", help="diagnose the published tables and figures instead"
    )
    diagnose.add_argument(
        "--json", action="store_true", help="print the report as JSON; files only with --out"
    )
    diagnose.add_argument(
        "--limit",
        type=_seconds,
        metavar="SECONDS",
        help="time limit for everything: the best explanation by then is reported, marked as such",
    )
    diagnose.add_argument(
        "--save-effect",
        metavar="NAME",
        help="save the free-form law that closes the gap of an unknown log as an effect for later "
        "diagnoses (in $NEEDLE_EFFECTS, else ~/.local/share/needle-torsion/effects)",
    )
    _add_output(diagnose, "diagnose", "; out/paper with --paper")


def _add_blind(blind: Parser) -> None:
    actions = blind.add_subparsers(dest="action", required=True, metavar="make|score")
    make = _subcommand(actions, "make", "write logs of an independent rig, ground truth separately")
    make.add_argument(
        "--out", type=Path, metavar="DIR", help="a new folder (default: out/blind, or numbered)"
    )
    make.add_argument("--seed", type=int, default=1, help="the same seed gives the same bytes")
    make.add_argument("--count", type=int, default=40, help="number of logs (default: 40)")
    make.add_argument(
        "--kinds",
        nargs="+",
        metavar="KIND",
        help="some of: none single pair off_nominal outside (default: these five), rough_none"
        " rough_single wrong_constant wrong_outside triple, or all",
    )
    make.add_argument("--effects", nargs="+", metavar="EFFECT", help="only these effects")
    make.add_argument(
        "--roughness",
        nargs="+",
        metavar="NAME",
        help="of the rough kinds, each of these in turn and alone (default: pairs of all ten)",
    )
    make.add_argument(
        "--signature",
        nargs=2,
        type=float,
        default=(1.0, 20.0),
        metavar=("LOW", "HIGH"),
        help="range of the rms of what each effect changes, in σ (default: 1 20)",
    )
    make.add_argument("--short", action="store_true", help="three trials of about 40 s in all")
    score = _subcommand(actions, "score", "diagnose the logs, then compare with the ground truth")
    score.add_argument("folder", type=Path, metavar="DIR", help="a folder with logs/ and answers/")
    score.add_argument("--limit", type=_seconds, metavar="SECONDS", help="time for each diagnosis")
    score.add_argument(
        "--trials", type=int, metavar="N", help="use the first N trials of every log only"
    )
    _add_engine(score)
    _add_output(score, "score")


def _add_campaign(campaign: Parser) -> None:
    campaign.add_argument(
        "file", type=Path, metavar="FILE.yaml", help="the campaign: see docs/campaigns.md"
    )
    campaign.add_argument(
        "--samples", type=int, metavar="N", help="number of draws, instead of that in the file"
    )
    campaign.add_argument(
        "--resume",
        action="store_true",
        help="compute only what is missing; without --out, in the folder that was begun last",
    )
    _add_engine(campaign)
    campaign.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="where results go (default: out/ and the campaign's name; numbered where it has results)",
    )
    campaign.add_argument("--force", action="store_true", help="replace results that exist")


def _add_engine(command: Parser) -> None:
    where = command.add_mutually_exclusive_group()
    where.add_argument("--workers", type=int, metavar="N", help="processes (default: one per core)")
    where.add_argument("--scheduler", metavar="ADDRESS", help="run on a dask.distributed cluster")


def _add_output(command: Parser, name: str, more: str = "") -> None:
    command.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help=f"where results go (default: out/{name}{more}; numbered where it has results)",
    )
    command.add_argument("--force", action="store_true", help="replace results that exist")
