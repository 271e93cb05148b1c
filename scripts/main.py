"""The console command `needle`: arguments, errors and exit codes.

0: done; 1: a bound of `needle validate` fails; 2: bad input, nothing written, or standard output full or
closed; 3: results without a picture, page or recording that could not be made; 130 and 143: stopped by
Ctrl-C or SIGTERM.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.text import Text

from models.errors import InvalidValue, NeedleError
from scripts.streams import complain, flush_output, give_up_output, show_what_can_be_shown
from scripts.terminal import terminal


def parser() -> argparse.ArgumentParser:
    """The arguments of every subcommand."""
    top = argparse.ArgumentParser(
        prog="needle",
        description="A flexible needle twisting in tissue: simulate, check, control, diagnose a rig.",
    )
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    demo = commands.add_parser(
        "demo", help="the main job: simulate, cross-check, replay a log, diagnose another"
    )
    _add_output(demo, default=Path("out/demo"))

    insert = commands.add_parser("insert", help="simulate a protocol")
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
    _add_output(insert, default=Path("out/insert"))

    commands.add_parser("protocols", help="list the protocols that are known by name")

    validate = commands.add_parser("validate", help="check the simulation against closed-form solutions")
    _add_output(validate, default=None)

    control = commands.add_parser("control", help="estimators and controllers: Tables IV and V")
    _add_output(control, default=Path("out/control"))

    _add_import(commands.add_parser("import", help="make a rig-log/1 folder of a lab's own files"))

    replay = commands.add_parser("replay", help="replay a rig's log on the nominal needle")
    replay.add_argument("log", type=Path, metavar="LOG", help="a rig-log/1 folder")
    _add_output(replay, default=Path("out/replay"))

    diagnose = commands.add_parser("diagnose", help="say what a rig has that its model lacks")
    diagnose.add_argument("log", type=Path, metavar="LOG", nargs="?", help="a rig-log/1 folder")
    diagnose.add_argument(
        "--paper", action="store_true", help="the published tables and figures instead"
    )
    diagnose.add_argument("--json", action="store_true", help="print report.json instead")
    diagnose.add_argument(
        "--limit",
        type=float,
        metavar="SECONDS",
        help="time for all of it: what explains the log best by then is told, marked as such",
    )
    _add_output(diagnose, default=None)

    _add_blind(commands.add_parser("blind", help="validate the diagnosis on rigs that it has not met"))

    _add_campaign(commands.add_parser("campaign", help="many runs from one file: sweeps, Monte-Carlo"))

    inspect = commands.add_parser("inspect", help="open a recording, or list its content")
    inspect.add_argument("file", type=Path, metavar="FILE.rrd")
    inspect.add_argument("--table", action="store_true", help="print a table; needs no screen")
    return top


def _add_import(importer: argparse.ArgumentParser) -> None:
    importer.add_argument(
        "files", type=Path, nargs="+", metavar="FILE", help="CSV or other text, Parquet, MAT, MCAP"
    )
    importer.add_argument(
        "--map", type=Path, metavar="FILE", help="a mapping.yaml; without it one is drafted"
    )
    importer.add_argument(
        "--accept-guesses", action="store_true", help="take the guesses of the mapping for confirmed"
    )
    _add_output(importer, default=Path("out/import"))


def _add_campaign(campaign: argparse.ArgumentParser) -> None:
    campaign.add_argument("file", type=Path, metavar="FILE.yaml", help="see docs/campaigns.md")
    campaign.add_argument("--samples", type=int, metavar="N", help="draws, in place of the file's")
    campaign.add_argument("--resume", action="store_true", help="compute only what is missing")
    where = campaign.add_mutually_exclusive_group()
    where.add_argument("--workers", type=int, metavar="N", help="processes (default: one per core)")
    where.add_argument("--scheduler", metavar="ADDRESS", help="run on a dask.distributed cluster")
    _add_output(campaign, default=None)


def _add_blind(blind: argparse.ArgumentParser) -> None:
    actions = blind.add_subparsers(dest="action", required=True, metavar="make|score")
    make = actions.add_parser("make", help="write logs of an independent rig, ground truth separately")
    make.add_argument("--out", type=Path, required=True, metavar="DIR", help="a new folder")
    make.add_argument("--seed", type=int, default=1, help="the same seed gives the same bytes")
    make.add_argument("--count", type=int, default=40, help="number of logs (default: 40)")
    make.add_argument(
        "--kinds",
        nargs="+",
        metavar="KIND",
        help="some of: none single pair off_nominal outside (default: these five), rough_none"
        " rough_single wrong_constant wrong_outside, or all",
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
    score = actions.add_parser("score", help="diagnose the logs, then compare with the ground truth")
    score.add_argument("folder", type=Path, metavar="DIR", help="with logs/ and answers/")
    score.add_argument("--limit", type=float, metavar="SECONDS", help="time for each diagnosis")
    score.add_argument(
        "--trials", type=int, metavar="N", help="use the first N trials of every log only"
    )
    _add_output(score, default=None)


def _add_output(command: argparse.ArgumentParser, *, default: Path | None) -> None:
    shown = f"where results go (default: {default})" if default else "also write results here"
    command.add_argument("--out", type=Path, metavar="DIR", default=default, help=shown)
    command.add_argument("--force", action="store_true", help="replace results that exist")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a subcommand; returns the exit code."""
    began_s = time.monotonic()
    args = parser().parse_args(arguments)
    show_what_can_be_shown()
    who = (f"needle {args.command}:", "bold red")
    try:
        code = _run(args, terminal(), began_s)
        flush_output()
        return code
    except NeedleError as error:
        complain(Text.assemble(who, f" {error}"))
        return 2
    except OSError as error:
        where = error.filename or "standard output"
        complain(Text.assemble(who, f" {where}: {error.strerror or error}"))
        give_up_output()
        return 2
    except KeyboardInterrupt:
        complain(f"needle {args.command}: interrupted; no incomplete file is left")
        return 130


def _run(args: argparse.Namespace, console: Console, began_s: float) -> int:
    # Imported here, for one command alone: `needle --help` need not wait for MuJoCo.
    match args.command:
        case "demo":
            from scripts import demo

            return demo.run(args.out, force=args.force, console=console)
        case "insert":
            from scripts import insert

            return insert.run(
                args.protocol,
                args.out,
                controller=args.controller,
                mjcf=args.mjcf,
                model=args.model,
                force=args.force,
                console=console,
            )
        case "protocols":
            from scripts import insert

            return insert.list_protocols(console)
        case "validate":
            from scripts import validate

            return validate.run(args.out, force=args.force, console=console)
        case "control":
            from scripts import control

            return control.run(args.out, force=args.force, console=console)
        case "diagnose" if bool(args.log) == args.paper:
            raise InvalidValue("LOG", args.log, "either a rig-log/1 folder or --paper")
        case "diagnose" if args.paper:
            from scripts import published_figures

            return published_figures.run(
                args.out, json_only=args.json, force=args.force, console=console
            )
        case "diagnose":
            from scripts import diagnose

            return diagnose.run(
                args.log,
                args.out,
                limit_s=args.limit,
                began_s=began_s,
                json_only=args.json,
                force=args.force,
                console=console,
            )
        case "blind" if args.action == "make":
            from scripts import blind

            return blind.make(
                args.out,
                seed=args.seed,
                count=args.count,
                kinds=args.kinds,
                effects=args.effects,
                roughness=args.roughness,
                signature=(args.signature[0], args.signature[1]),
                short=args.short,
                console=console,
            )
        case "blind":
            from scripts import blind

            return blind.run_score(
                args.folder,
                args.out,
                trials=args.trials,
                limit_s=args.limit,
                force=args.force,
                console=console,
            )
        case "import":
            from scripts import import_log

            return import_log.run(
                args.files,
                args.out,
                mapping=args.map,
                accept_guesses=args.accept_guesses,
                force=args.force,
                console=console,
            )
        case "campaign":
            from scripts import campaign

            return campaign.run(
                args.file,
                args.out,
                samples=args.samples,
                resume=args.resume,
                workers=args.workers,
                scheduler=args.scheduler,
                force=args.force,
                console=console,
            )
        case "replay":
            from scripts import replay

            return replay.run(args.log, args.out, force=args.force, console=console)
        case _:
            from scripts import inspect

            return inspect.run(args.file, table=args.table, console=console)


if __name__ == "__main__":
    sys.exit(main())
