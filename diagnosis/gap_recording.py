"""`gap.rrd`: measured, nominal and explained side by side, trial after trial.

A side stream: nothing that computes imports this module.
"""

from pathlib import Path
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from diagnosis.diagnose import Diagnosis
from diagnosis.rig_log import SENSORS
from sim.files import writing
from sim.rerun_log import APPLICATION, log_series

_COLOURS = {"measured": [150, 150, 150], "nominal": [31, 119, 180], "explained": [214, 39, 40]}
_LABELS = {"tip_angle_deg": "tip, deg", "base_torque_n_mm": "base torque, N mm"}


def log_gap(diagnosis: Diagnosis, sentence: str, path: Path, *, force: bool = False) -> None:
    """Write the recording; `sentence` is the verdict in words.

    Raises:
      OutputExists: the path exists and `force` is not given.
    """
    rr.set_strict_mode(True)
    with writing(path, force=force) as part:
        stream = rr.RecordingStream(f"{APPLICATION}-gap")
        stream.save(part, default_blueprint=_blueprint(diagnosis))
        stream.log("about", rr.TextDocument(f"# {sentence}", media_type="text/markdown"), static=True)
        each = zip(diagnosis.log.trials, diagnosis.nominal, diagnosis.explained, strict=True)
        for i, (trial, nominal, explained) in enumerate(each):
            time = trial["time_s"]
            for sensor in SENSORS:
                shown = {"nominal": nominal[sensor], "explained": explained[sensor]}
                if trial.has(sensor):
                    shown = {"measured": trial[sensor]} | shown
                    noise = diagnosis.noise[sensor]
                    for name in ("nominal", "explained"):
                        left = (trial[sensor] - shown[name]) / noise
                        entity = f"trial_{i + 1}/residual/{sensor}/{name}"
                        log_series(stream, entity, name, time, np.nan_to_num(left), _COLOURS[name])
                for name, values in shown.items():
                    entity = f"trial_{i + 1}/{sensor}/{name}"
                    log_series(stream, entity, name, time, values, _COLOURS[name])
        stream.disconnect()


def _blueprint(diagnosis: Diagnosis) -> Any:
    """A tab a trial: both sensors above, their residuals over noise below."""
    tabs = []
    for i, trial in enumerate(diagnosis.log.trials):
        root = f"/trial_{i + 1}"
        above = [rrb.TimeSeriesView(origin=f"{root}/{s}", name=_LABELS[s]) for s in SENSORS]
        below = [
            rrb.TimeSeriesView(origin=f"{root}/residual/{s}", name=f"{_LABELS[s]}: over noise")
            for s in SENSORS
        ]
        tabs.append(rrb.Vertical(rrb.Horizontal(*above), rrb.Horizontal(*below), name=trial.name))
    text = rrb.TextDocumentView(origin="/about", name="Verdict")
    layout = rrb.Vertical(text, rrb.Tabs(*tabs), row_shares=[1, 6])
    return rrb.Blueprint(layout, collapse_panels=True)
