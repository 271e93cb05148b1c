"""`needle replay`: a rig's log beside the predictions of its nominal rig."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rich.console import Console
from rich.table import Table

from diagnosis.in_sigma import in_sigma, over_sigma
from diagnosis.log.rig_log import RigLog, files_of, read_rig_log
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.nominal_replay import NominalReplay, replay_nominal
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import shape_of
from diagnosis.residuals.between_readings import between_readings
from models.user_text import in_figure
from scripts.output_folder import output_folder
from scripts.progress_line import ByShare, stage_line, unheard, within
from scripts.results import tell
from scripts.streams import complain
from scripts.tables import print_table
from sim.files import Destination, ResultSet, finish_interrupted, publishing, write_text
from sim.recording.recording import record
from sim.recording.rerun_log import log_recording

DEFAULT = Path("out/replay")
_REPLAYED = 0.2  # of the time: what is left is for writing
_TABLES, _PICTURE = 0.05, 0.6  # of the time of writing, until they are done
Pair = tuple[PreparedTrial, Prediction]

_LABELS = {"tip_angle_deg": "tip, deg", "base_torque_n_mm": "base torque, N mm"}


@dataclass(frozen=True, kw_only=True)
class ReplayedTrial:
    """A trial, and the predictions of the nominal rig at its samples."""

    trial: Trial
    prediction: Prediction


def run(log_folder: Path, out: Path | None, *, force: bool, console: Console) -> int:
    """Replay every trial; writes predictions, a picture and a recording of the first."""
    finish_interrupted(log_folder)
    log = read_rig_log(log_folder)
    outputs, inputs = partial(output_paths, log), files_of(log, log_folder)
    destination = output_folder(out, DEFAULT, outputs, inputs=inputs, force=force)
    for warning in log.warnings:
        complain(f"warning: {warning}")
    with stage_line() as stage:
        stage("replaying the nominal rig", 0.0)
        nominal = replay_nominal(log)
        written = write(nominal, destination, within(stage, _REPLAYED))
    found = nominal.problem
    for warning in (*nominal.log.warnings, *found.log.warnings, *found.noise.warnings):
        console.print(f"warning: {warning}", highlight=False)
    print_table(console, table(nominal))
    return tell(written, console)


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """All files that `write` writes."""
    predictions = [folder / "predictions" / trial.name for trial in log.trials]
    return [folder / "replay.png", folder / "replay.rrd", *predictions]


def gap(nominal: NominalReplay, sensor: str, trial: int | None = None) -> float:
    """Root mean square of the residual / sigma, as in a diagnosis; NaN if not measured.

    Args:
      trial: index of a trial; None: all trials together.
    """
    each = list(zip(nominal.problem.log.trials, nominal.predictions, strict=True))
    left = [t.readings[sensor] - p[sensor] for t, p in _chosen(each, trial) if t.has(sensor)]
    if not left:
        return float("nan")
    return float(np.sqrt(np.nanmean(np.concatenate(left) ** 2))) / nominal.problem.noise[sensor]


def table(nominal: NominalReplay) -> Table:
    """The gap of each trial, in units of the estimated noise."""
    noise = nominal.problem.noise
    heads = [f"{label} (σ {noise[s]:.3g})" for s, label in _LABELS.items()]
    shown = Table("trial", "samples", *heads, title="Residual of the nominal model / σ")
    for i, trial in enumerate(nominal.problem.log.trials):
        shown.add_row(trial.name, str(int(trial.logged.sum())), *_cells(nominal, i))
    samples = sum(int(trial.logged.sum()) for trial in nominal.problem.log.trials)
    shown.add_row("all", str(samples), *_cells(nominal, None), end_section=True)
    return shown


def _cells(nominal: NominalReplay, trial: int | None) -> list[str]:
    gaps = [gap(nominal, sensor, trial) for sensor in _LABELS]
    return ["not measured" if np.isnan(g) else over_sigma(g) for g in gaps]


def _chosen(each: list[Pair], trial: int | None) -> list[Pair]:
    return each if trial is None else [each[trial]]


def write(nominal: NominalReplay, destination: Destination, stage: ByShare = unheard) -> ResultSet:
    """Predictions as CSV; then residuals as a picture, the first trial as a recording."""
    log = nominal.log
    paths = output_paths(log, destination.folder)
    each = zip(log.trials, nominal.problem.log.trials, nominal.predictions, strict=True)
    replayed = [
        ReplayedTrial(trial=trial, prediction=prediction.rows(prepared.logged))
        for trial, prepared, prediction in each
    ]
    with publishing(destination, paths) as written:
        picture, rrd, *predictions = paths
        stage("writing predictions", 0.0)
        for one, path in zip(replayed, predictions, strict=True):
            table = _predicted(one).to_csv(index=False, float_format="%.6g")
            write_text(written.at(path), table)
        stage("drawing", _TABLES)
        written.optional(picture, partial(_draw, replayed))
        stage("making the recording for the viewer", _PICTURE)
        written.optional(rrd, partial(_record, nominal))
    return written


def _predicted(one: ReplayedTrial) -> pd.DataFrame:
    """The predictions at the rows of the trial's file."""
    rows = one.trial.file_rows
    there = one.prediction.at(rows.taken_s, one.trial["time_s"])
    return pd.DataFrame({"time_s": rows.stamps_s} | {f"{s}_nominal": there[s] for s in SENSORS})


def _record(nominal: NominalReplay, path: Path) -> None:
    log, first = nominal.log, nominal.problem.log.trials[0]
    shape = shape_of(log.rig, first, nominal.rig)
    results = [f"residual, {s}: {in_sigma(gap(nominal, s, 0))}" for s in SENSORS if first.has(s)]
    parameters = {
        "protocol": first.name,
        "description": "the nominal needle on a rig's motion, and what the rig measured",
    }
    measured = _measured(log.trials[0])
    log_recording(record(shape, parameters), path, measured=measured, results=results)


def _measured(trial: Trial) -> pd.DataFrame:
    """The readings of a trial at its own samples, with the signal names of recordings."""
    names = {
        "base_angle_deg": "measured_base_deg",
        "tip_angle_deg": "measured_tip_deg",
        "base_torque_n_mm": "measured_torque_n_mm",
    }
    there = {name: column for column, name in names.items() if trial.has(column)}
    time_s = trial["time_s"]
    return pd.DataFrame(
        {"time_s": time_s} | {n: between_readings(time_s, trial[c]) for n, c in there.items()}
    )


def _draw(replayed: list[ReplayedTrial], path: Path) -> None:
    size = (11, 2.2 * len(replayed) + 1)
    figure, axes = plt.subplots(len(replayed), 2, figsize=size, layout="constrained", squeeze=False)
    for row, one in zip(axes, replayed, strict=True):
        time_s = one.trial["time_s"]
        for axis, (sensor, label) in zip(row, _LABELS.items(), strict=True):
            if one.trial.has(sensor):
                measured = between_readings(time_s, one.trial[sensor])
                axis.plot(time_s, measured, color="0.6", lw=0.8, label="measured")
            axis.plot(time_s, one.prediction[sensor], color="tab:red", lw=1, label="nominal")
            axis.set(ylabel=label)
        row[0].set_title(in_figure(one.trial.name), loc="left", fontsize=9)
    for axis in axes[-1]:
        axis.set(xlabel="time, s")
    axes[0, 0].legend(fontsize=8)
    figure.savefig(path, dpi=110, format="png")
    plt.close(figure)
