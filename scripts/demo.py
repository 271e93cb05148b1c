"""`needle demo`: the main steps in one command.

A simulated insertion, the cross-check against the closed-form modes, the replay of an example
log, and the diagnosis of another one.
"""

import time
from dataclasses import replace
from pathlib import Path

from rich.console import Console
from rich.text import Text

from diagnosis.log.rig_log import files_of, read_rig_log
from diagnosis.nominal_replay import replay_nominal
from diagnosis.report.write import output_paths as report_paths
from scripts import diagnose as diagnosing
from scripts import insert
from scripts import replay as replaying
from scripts import validate as validating
from scripts.exit_codes import ExitCode
from scripts.output_folder import output_folder
from scripts.progress_line import stage_line
from scripts.results import tell
from scripts.tables import print_table
from sim.experiment import perform
from sim.paper_protocols import protocol_named
from sim.simulation import prepare_processes
from studies.crosscheck.report import output_paths as check_paths

_PLACES = [folder / "examples" for folder in Path(__file__).resolve().parents[:2]]
EXAMPLES = next(place for place in _PLACES if place.is_dir())
"""Beside this file where installed, one folder higher in the repository."""
EXAMPLE, DRY = EXAMPLES / "rig-log", EXAMPLES / "rig-log-dry"
DEFAULT = Path("out/demo")
_STAGES = 5


def run(out: Path | None, *, force: bool, console: Console) -> int:
    """Returns 1 if a bound of the cross-check fails."""
    protocol, log, dry = protocol_named("insertion"), read_rig_log(EXAMPLE), read_rig_log(DRY)

    def outputs(to: Path) -> list[Path]:
        checked, replayed = check_paths(to / "validate"), to / "replay"
        written = [*insert.output_paths(to, protocol), *checked]
        return [*written, *replaying.output_paths(log, replayed), *report_paths(dry, to / "gap")]

    inputs = (*files_of(log, EXAMPLE), *files_of(dry, DRY))
    whole = output_folder(out, DEFAULT, outputs, inputs=inputs, force=force)
    folder = whole.folder
    began = time.monotonic()

    _announce(console, 1, "compiling the tissue (once per machine, up to a minute)")
    prepare_processes()
    _announce(console, 2, f"insertion: {protocol.description}")
    recording = perform(protocol)
    simulated = insert.write(recording, whole, protocol)
    print_table(console, insert.summary(protocol, recording))

    _announce(console, 3, "cross-check against closed-form solutions")
    findings, checked = validating.checked(replace(whole, folder=folder / "validate"))
    print_table(console, validating.poles_table(findings), keys=3)
    print_table(console, validating.checks_table(findings))

    _announce(console, 4, f"replay of {len(log.trials)} trials of a rig")
    with stage_line() as stage:
        stage("replaying", 0.0)
        nominal = replay_nominal(log)
    replayed = replaying.write(nominal, replace(whole, folder=folder / "replay"))
    print_table(console, replaying.table(nominal))

    _announce(console, 5, "what a rig has that its model lacks")
    stopped = diagnosing.run(DRY, folder / "gap", json_only=False, force=force, console=console)

    codes = [tell(written, console) for written in (simulated, checked, replayed)]
    console.print(f"done in {time.monotonic() - began:.0f} s; look at a recording with")
    show_command = f"  needle inspect {folder / (protocol.name + '.rrd')}"
    console.print(show_command, highlight=False, soft_wrap=True)
    console.print(f"and open {folder / 'gap' / 'report.html'}", highlight=False, soft_wrap=True)
    return stopped or max(codes) if findings.passed else ExitCode.BOUND_FAILS


def _announce(console: Console, stage: int, what: str) -> None:
    console.print(Text.assemble((f"{stage}/{_STAGES}", "bold"), f" {what}"))
