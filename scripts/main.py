"""The console command `needle`: runs a subcommand, and turns errors into messages and exit codes."""

import argparse
import gc
import time
from collections.abc import Sequence
from typing import NoReturn

from rich.console import Console
from rich.text import Text

from models.errors import InvalidValue, NeedleError
from scripts.arguments import parsed
from scripts.exit_codes import ExitCode, end_process, let_the_code_stand
from scripts.output_folder import release_folders
from scripts.streams import complain, flush_output, give_up_output, show_what_can_be_shown
from scripts.terminal import terminal

_CYCLES_AFTER = 100_000  # objects, instead of 700: those that an import makes are no garbage


def run_process() -> NoReturn:
    """Run the subcommand of the command line, and end this process with its exit code."""
    gc.set_threshold(_CYCLES_AFTER)
    end_process(main())


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a subcommand; returns the exit code."""
    began_s = time.monotonic()
    show_what_can_be_shown()
    args = parsed(arguments)
    who = (f"needle {args.command}:", "bold red")
    try:
        code = _run(args, terminal(), began_s)
        flush_output()
        return code
    except NeedleError as error:
        complain(Text.assemble(who, f" {error}"))
        return ExitCode.REFUSED
    except OSError as error:
        where = error.filename or "standard output"
        complain(Text.assemble(who, f" {where}: {error.strerror or error}"))
        give_up_output()
        return ExitCode.REFUSED
    except KeyboardInterrupt:
        let_the_code_stand()
        complain(f"needle {args.command}: interrupted; no incomplete file is left")
        return ExitCode.INTERRUPTED
    finally:
        release_folders()


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
                save_effect=args.save_effect,
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
                workers=args.workers,
                scheduler=args.scheduler,
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
        case "completion":
            from scripts import completion

            return completion.run(args.shell, console)
        case _:
            from scripts import inspect

            return inspect.run(args.file, table=args.table, console=console)


if __name__ == "__main__":
    run_process()
