"""A recording as a rerun file: the needle in 3-D, its signals, its parameters.

Output only: nothing that computes imports this module.
"""

import json
from collections.abc import Sequence
from pathlib import Path

import pandas as pd
import rerun as rr

from models.user_text import in_markdown
from sim.recording.recording import Recording, unit_of
from sim.recording.rerun_file import recorded
from sim.recording.rerun_layout import application, blueprint
from sim.recording.rerun_plots import log_modes, log_plots
from sim.recording.rerun_shaft import log_path, log_shaft


def log_recording(
    recording: Recording,
    path: Path,
    *,
    measured: pd.DataFrame | None = None,
    results: Sequence[str] = (),
    force: bool = False,
) -> None:
    """Write a recording as `.rrd`, with a layout for the viewer.

    Args:
      measured: signals of a rig to show beside those of the recording, with their own `time_s`.
      results: lines of text to show below the title.

    Raises:
      OutputExists: the path exists and `force` is not given.
    """
    with recorded(application(recording), blueprint(recording), path, force=force) as stream:
        _log_text(stream, recording, results)
        log_plots(stream, recording.table)
        if measured is not None:
            log_plots(stream, measured)
        log_modes(stream, recording)
        log_path(stream, recording)
        log_shaft(stream, recording)


def _log_text(stream: rr.RecordingStream, recording: Recording, results: Sequence[str]) -> None:
    lines = [f"# {in_markdown(str(recording.parameters.get('protocol', 'Recording')))}", ""]
    lines += [in_markdown(str(recording.parameters.get("description", ""))), ""]
    lines += [f"- {in_markdown(line)}" for line in results]
    lines += ["", "## Signals", ""]
    lines += [f"- `{name}`, {unit_of(name)}" for name in recording.names]
    text = json.dumps(recording.parameters, indent=1)
    lines += ["", "## Parameters", "", "```json", text, "```"]
    stream.log("about", rr.TextDocument("\n".join(lines), media_type="text/markdown"), static=True)
