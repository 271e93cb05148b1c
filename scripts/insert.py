"""`needle insert`: simulate a protocol and write its recording."""

from dataclasses import replace
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.table import Table

from models.errors import InvalidValue, UnknownName
from models.user_text import in_xml_comment
from scripts.output_folder import output_folder
from scripts.progress_line import ByShare, stage_line, unheard, within
from scripts.results import tell
from scripts.tables import print_table
from sim.experiment import perform
from sim.files import Destination, ResultSet, publishing, write_text
from sim.model_file import read_model
from sim.paper_protocols import PROTOCOLS, protocol_named
from sim.protocol import Protocol, read_protocol
from sim.recording.picture import draw
from sim.recording.recording import Recording
from sim.recording.rerun_log import log_recording
from sim.spec import needle_spec
from studies.control.closed_loop_run import perform_closed_loop
from studies.control.tip_controllers import TIP_CONTROLLERS

DEFAULT = Path("out/insert")
ENDINGS = (".csv", ".parquet", ".png", ".rrd")
_SIMULATED, _CONTROLLED = 0.1, 0.4  # of the time: what is left is for writing
_TABLES, _PICTURE = 0.15, 0.6  # of the time of writing, until they are done

_MJCF_NOTE = """<!--
  needle-torsion: {name}. SI units; the shaft lies along x.
  Opens in MuJoCo's viewer: turn the base with the control "drive", advance with "carriage".
  The needle is this file's: change joint stiffness, body inertia, actuators or the time step,
  then run it with the option "model" of `needle insert`, beside the same protocol.
  The tissue is not in this file's physics: its law is in the custom numeric fields, and
  acts only where the library's passive callback is installed.
-->
"""


def run(
    name: str,
    out: Path | None,
    *,
    controller: str | None,
    mjcf: Path | None,
    model: Path | None,
    force: bool,
    console: Console,
) -> int:
    """Simulate a protocol by name or YAML file, in closed loop if a controller is named.

    Args:
      mjcf: path to write the model to; model: path of the model to run; None: the protocol's own.

    Raises:
      InvalidValue: `model` together with `mjcf` or `controller`.
      UnknownName: no such protocol or controller.
    """
    protocol = find(name)
    if model and (mjcf or controller):
        raise InvalidValue("--model", str(model), "neither --mjcf nor --controller beside it")
    if controller is not None and controller not in TIP_CONTROLLERS:
        raise UnknownName("--controller", controller, TIP_CONTROLLERS)

    def beside(folder: Path) -> list[Path]:
        """Further results of the folder: the model, if it is written inside."""
        return [mjcf] if mjcf and mjcf.is_relative_to(folder) else []

    inputs = (*([Path(name)] if _is_file(name) else []), *([model] if model else []))
    destination = output_folder(
        out,
        DEFAULT,
        lambda to: [*output_paths(to, protocol), *beside(to)],
        inputs=inputs,
        force=force,
    )
    inside = beside(destination.folder)
    aside = replace(destination, folder=mjcf.parent) if mjcf and not inside else None
    if mjcf and aside:
        aside.check([mjcf])
    with stage_line() as stage:
        simulated = _CONTROLLED if controller else _SIMULATED
        heard = partial(within(stage, 0.0, simulated), f"simulating {protocol.name}")
        heard(0.0)
        if controller:
            recording = perform_closed_loop(protocol, controller, heard)
        else:
            recording = perform(protocol, read_model(model, protocol.setup()) if model else None)
        if mjcf and aside:
            with publishing(aside, [mjcf]) as apart:
                _write_model(protocol, apart.at(mjcf))
        model_inside = mjcf if inside else None
        rest = within(stage, simulated)
        written = write(recording, destination, protocol, mjcf=model_inside, stage=rest)
    if aside:
        console.print(f"model      {mjcf}", highlight=False, soft_wrap=True)
    code = tell(written, console)
    print_table(console, summary(protocol, recording))
    return code


def _write_model(protocol: Protocol, path: Path) -> None:
    note = _MJCF_NOTE.format(name=in_xml_comment(protocol.name))
    write_text(path, note + needle_spec(protocol.setup()).to_xml())


def find(name: str) -> Protocol:
    """A protocol from a file, if the name looks like one, else by its name."""
    return read_protocol(Path(name)) if _is_file(name) else protocol_named(name)


def _is_file(name: str) -> bool:
    return name.endswith((".yaml", ".yml")) or "/" in name


def output_paths(folder: Path, protocol: Protocol) -> list[Path]:
    """All files that `write` writes."""
    return [folder / f"{protocol.name}{ending}" for ending in ENDINGS]


def write(
    recording: Recording,
    destination: Destination,
    protocol: Protocol,
    *,
    mjcf: Path | None = None,
    stage: ByShare = unheard,
) -> ResultSet:
    """Write CSV and Parquet, and the model if asked for; then picture and rerun recording."""
    paths = output_paths(destination.folder, protocol)
    with publishing(destination, [*paths, *([mjcf] if mjcf else [])]) as written:
        csv, parquet, picture, rrd = paths
        stage("writing tables", 0.0)
        recording.write(written.at(csv))
        recording.write(written.at(parquet))
        if mjcf:
            _write_model(protocol, written.at(mjcf))
        stage("drawing", _TABLES)
        written.optional(picture, partial(draw, recording))
        stage("making the recording for the viewer", _PICTURE)
        written.optional(rrd, partial(log_recording, recording, results=results(recording)))
    return written


def results(recording: Recording) -> list[str]:
    """Results of the run, one line each."""
    lag = abs(recording["base_angle_deg"] - recording["tip_angle_deg"])
    at = recording["time_s"][lag.argmax()]
    lines: list[str] = []
    if "wanted_tip_deg" in recording.table:
        error = abs(recording["wanted_tip_deg"] - recording["tip_angle_deg"])[-1]
        worst = abs(recording["estimate_tip_deg"] - recording["tip_angle_deg"]).max()
        lines += [f"tip error at the end: {error:.2f} deg"]
        lines += [f"largest error of the estimate: {worst:.2f} deg"]
    failed = int(recording["unconverged_count"][-1])
    lines += [
        f"largest lag of the tip: {lag.max():.1f} deg, at {at:.2f} s",
        f"lag at the end: {lag[-1]:.2f} deg",
        f"largest base torque: {abs(recording['base_torque_n_mm']).max():.3f} N mm",
        f"steps that did not converge: {failed or 'none'}",
    ]
    unknown = recording.parameters["tissue"]["unknown"]
    return lines + [f"not stated by the source: {what}" for what in unknown]


def summary(protocol: Protocol, recording: Recording) -> Table:
    """The results as a table."""
    table = Table(title=protocol.description or protocol.name, show_header=False)
    for line in results(recording):
        name, _, value = line.partition(": ")
        table.add_row(name, value)
    return table


def list_protocols(console: Console) -> int:
    """Print the protocols that are known by name."""
    table = Table("name", "experiment", title="Protocols")
    for name, make in PROTOCOLS.items():
        table.add_row(name, make().description)
    print_table(console, table)
    return 0
