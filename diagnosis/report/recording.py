"""`gap.rrd`: measured, nominal and explained side by side, trial after trial.

A side stream: nothing that computes imports this module.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from diagnosis.log.trial import SENSORS, Trial
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.replay.prediction import Prediction
from diagnosis.report.needle_view import log_needle, needle_bounds
from diagnosis.report.sentences.names import label_of
from diagnosis.residuals.between_readings import between_readings
from diagnosis.result import Diagnosis
from sim.recording.rerun_file import recorded
from sim.recording.rerun_layout import APPLICATION
from sim.recording.rerun_series import log_series

Array = NDArray[np.float64]

_COLOURS = {"measured": [150, 150, 150], "nominal": [31, 119, 180], "explained": [214, 39, 40]}
_LABELS = {"tip_angle_deg": "tip, deg", "base_torque_n_mm": "base torque, N mm"}


def log_gap(diagnosis: Diagnosis, sentence: str, path: Path) -> None:
    """Write the recording; `sentence` is the verdict in words.

    Raises:
      OutputExists: the path exists.
    """
    with recorded(f"{APPLICATION}-gap", _blueprint(diagnosis), path) as stream:
        stream.log("about", rr.TextDocument(f"# {sentence}", media_type="text/markdown"), static=True)
        each = zip(diagnosis.log.trials, diagnosis.nominal, diagnosis.assessment.explained, strict=True)
        for i, (trial, nominal, explained) in enumerate(each):
            predictions = {"nominal": nominal, "explained": explained}
            root = f"trial_{i + 1}"
            _log_signals(stream, root, diagnosis, trial, predictions)
            left_over = _residuals(trial, predictions, diagnosis.noise)
            for (name, sensor), left in left_over.items():
                entity = f"{root}/residual/{sensor}/{name}"
                label = label_of(diagnosis, name)
                log_series(stream, entity, label, trial["time_s"], left, _COLOURS[name])
            log_needle(stream, f"{root}/needle", trial, left_over)


def _log_signals(
    stream: Any, root: str, diagnosis: Diagnosis, trial: Trial, predictions: Mapping[str, Prediction]
) -> None:
    for sensor in SENSORS:
        shown = {name: prediction[sensor] for name, prediction in predictions.items()}
        if trial.has(sensor):
            shown = {"measured": between_readings(trial["time_s"], trial[sensor])} | shown
        for name, values in shown.items():
            entity, label = f"{root}/{sensor}/{name}", label_of(diagnosis, name)
            log_series(stream, entity, label, trial["time_s"], values, _COLOURS[name])


def _residuals(
    trial: Trial, predictions: Mapping[str, Prediction], noise: Noise
) -> dict[tuple[str, str], Array]:
    """Measured minus predicted / sigma, by prediction and sensor; 0 where nothing was measured."""
    return {
        (name, sensor): np.nan_to_num(
            between_readings(trial["time_s"], (trial[sensor] - prediction[sensor]) / noise[sensor])
        )
        for name, prediction in predictions.items()
        for sensor in SENSORS
        if trial.has(sensor)
    }


def _blueprint(diagnosis: Diagnosis) -> Any:
    """A tab per trial: both sensors, their residuals / sigma, and these on the needle."""
    tabs = []
    for i, trial in enumerate(diagnosis.log.trials):
        root = f"/trial_{i + 1}"
        above = [rrb.TimeSeriesView(origin=f"{root}/{s}", name=_LABELS[s]) for s in SENSORS]
        below = [
            rrb.TimeSeriesView(origin=f"{root}/residual/{s}", name=f"{_LABELS[s]}: residual / σ")
            for s in SENSORS
        ]
        needle = rrb.Spatial2DView(
            origin=f"{root}/needle", name="residual on the needle", visual_bounds=needle_bounds(trial)
        )
        signals, residuals = rrb.Horizontal(*above), rrb.Horizontal(*below)
        shares = [3, 3, 1]
        tabs.append(rrb.Vertical(signals, residuals, needle, row_shares=shares, name=trial.name))
    text = rrb.TextDocumentView(origin="/about", name="Verdict")
    layout = rrb.Vertical(text, rrb.Tabs(*tabs), row_shares=[1, 6])
    return rrb.Blueprint(layout, collapse_panels=True)
