"""`needle demo`: the main job, from one command.

A simulated insertion, the cross-check against the closed-form modes, the replay of a
rig's log that ships with the project, and what another rig has that its model lacks.
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
from scripts.results import tell
from sim.experiment import perform
from sim.files import Destination
from sim.paper_protocols import protocol_named
from sim.simulation import prepare_processes
from studies.crosscheck.report import cross_check, write_report
from studies.crosscheck.report import output_paths as check_paths

_PLACES = [folder / "examples" for folder in Path(__file__).resolve().parents[:2]]
EXAMPLES = next(place for place in _PLACES if place.is_dir())
"""Beside this file where installed, one folder higher in the repository."""
EXAMPLE, DRY = EXAMPLES / "rig-log", EXAMPLES / "rig-log-dry"
_STAGES = 5


def run(folder: Path, *, force: bool, console: Console) -> int:
    """Returns 1 if a bound of the cross-check fails."""
    protocol, log = protocol_named("insertion"), read_rig_log(EXAMPLE)
    paths = insert.output_paths(folder, protocol)
    paths += check_paths(folder / "validate")
    paths += replaying.output_paths(log, folder / "replay")
    paths += report_paths(read_rig_log(DRY), folder / "gap")
    inputs = (*files_of(log, EXAMPLE), *files_of(read_rig_log(DRY), DRY))
    whole = Destination(folder=folder, inputs=inputs, force=force)
    whole.check(paths)
    began = time.monotonic()

    _announce(console, 1, "compiling the tissue (once per machine, about 20 s)")
    prepare_processes()
    _announce(console, 2, f"insertion: {protocol.description}")
    recording = perform(protocol)
    simulated = insert.write(recording, whole, protocol)
    console.print(insert.summary(protocol, recording))

    _announce(console, 3, "cross-check against closed-form solutions")
    findings = cross_check()
    checked = write_report(findings, replace(whole, folder=folder / "validate"))
    console.print(validating.poles_table(findings))
    console.print(validating.checks_table(findings))

    _announce(console, 4, f"replay of {len(log.trials)} trials of a rig")
    nominal = replay_nominal(log)
    replayed = replaying.write(nominal, replace(whole, folder=folder / "replay"))
    console.print(replaying.table(nominal))

    _announce(console, 5, "what a rig has that its model lacks")
    stopped = diagnosing.run(DRY, folder / "gap", json_only=False, force=force, console=console)

    codes = [tell(written, console) for written in (simulated, checked, replayed)]
    console.print(f"done in {time.monotonic() - began:.0f} s; look at a recording with")
    console.print(f"  needle inspect {folder / (protocol.name + '.rrd')}", highlight=False)
    console.print(f"and open {folder / 'gap' / 'report.html'}", highlight=False)
    return stopped or max(codes) if findings.passed else 1


def _announce(console: Console, stage: int, what: str) -> None:
    console.print(Text.assemble((f"{stage}/{_STAGES}", "bold"), f" {what}"))
