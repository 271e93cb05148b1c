"""`needle replay`: a rig's log beside what its nominal rig predicts."""

from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rich.console import Console
from rich.table import Table

from diagnosis.log.rig_log import RigLog, read_rig_log
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.pipeline import NominalReplay, replay_nominal
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.replay import Prediction, shape_of
from diagnosis.replay.rig_parameters import NOMINAL
from sim.files import refuse_existing, writing
from sim.recording import record
from sim.rerun_log import log_recording

_LABELS = {"tip_angle_deg": "tip, deg", "base_torque_n_mm": "base torque, N mm"}


@dataclass(frozen=True, kw_only=True)
class ReplayedTrial:
    """A trial beside what the nominal rig predicts at its samples."""

    trial: Trial
    prediction: Prediction


def run(log_folder: Path, folder: Path, *, force: bool, console: Console) -> int:
    """Replay every trial; writes predictions, a picture and a recording of the first."""
    log = read_rig_log(log_folder)
    paths = output_paths(log, folder)
    refuse_existing(paths, force=force)
    for warning in log.warnings:
        console.print(f"warning: {warning}", highlight=False, markup=False)
    with console.status(f"replaying {len(log.trials)} trials"):
        nominal = replay_nominal(log)
    for warning in nominal.problem.noise.warnings:
        console.print(f"warning: {warning}", highlight=False, markup=False)
    console.print(table(nominal))
    write(log, nominal, folder, force=force)
    for path in paths:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """What `write` will write."""
    predictions = [folder / "predictions" / trial.name for trial in log.trials]
    return [folder / "replay.png", folder / "replay.rrd", *predictions]


def gap(nominal: NominalReplay, trial: PreparedTrial, prediction: Prediction, sensor: str) -> float:
    """Root mean square of the residual / sigma, as in a diagnosis; NaN if not measured."""
    if not trial.has(sensor):
        return float("nan")
    left = (trial.readings[sensor] - prediction[sensor]) / nominal.problem.noise[sensor]
    return float(np.sqrt(np.nanmean(left**2)))


def table(nominal: NominalReplay) -> Table:
    """The gap of each trial, in units of the noise that the readings show."""
    shown = Table("trial", "samples", "tip", "base torque", title="Residual of the nominal model / σ")
    for trial, prediction in zip(nominal.problem.log.trials, nominal.predictions, strict=True):
        gaps = [gap(nominal, trial, prediction, s) for s in ("tip_angle_deg", "base_torque_n_mm")]
        cells = ["not measured" if np.isnan(g) else f"{g:.2f}" for g in gaps]
        shown.add_row(trial.name, str(int(trial.logged.sum())), *cells)
    noise = nominal.problem.noise
    shown.caption = ", ".join(f"{s}: σ = {noise[s]:.3g}" for s in SENSORS)
    return shown


def write(log: RigLog, nominal: NominalReplay, folder: Path, *, force: bool) -> None:
    """Predictions as CSV, residuals as a picture, the first trial as a recording."""
    picture, rrd, *predictions = output_paths(log, folder)
    each = zip(log.trials, nominal.problem.log.trials, nominal.predictions, strict=True)
    replayed = [
        ReplayedTrial(trial=trial, prediction=prediction.rows(prepared.logged))
        for trial, prepared, prediction in each
    ]
    for one, path in zip(replayed, predictions, strict=True):
        columns = {"time_s": one.trial["time_s"]}
        columns |= {f"{name}_nominal": one.prediction[name] for name in SENSORS}
        with writing(path, force=force) as part:
            pd.DataFrame(columns).to_csv(part, index=False, float_format="%.6g")
    _draw(replayed, picture, force=force)
    first, prediction = nominal.problem.log.trials[0], nominal.predictions[0]
    shape = shape_of(log.rig, first, NOMINAL)
    gaps = {s: gap(nominal, first, prediction, s) for s in SENSORS}
    verdicts = [f"residual, {s}: {value:.2f} σ" for s, value in gaps.items()]
    parameters = {"protocol": first.name, "description": "the nominal needle on a rig's motion"}
    log_recording(record(shape, parameters), rrd, verdicts=verdicts, force=force)


def _draw(replayed: list[ReplayedTrial], path: Path, *, force: bool) -> None:
    size = (11, 2.2 * len(replayed) + 1)
    figure, axes = plt.subplots(len(replayed), 2, figsize=size, layout="constrained", squeeze=False)
    for row, one in zip(axes, replayed, strict=True):
        time_s = one.trial["time_s"]
        for axis, (sensor, label) in zip(row, _LABELS.items(), strict=True):
            if one.trial.has(sensor):
                axis.plot(time_s, one.trial[sensor], color="0.6", lw=0.8, label="measured")
            axis.plot(time_s, one.prediction[sensor], color="tab:red", lw=1, label="nominal")
            axis.set(ylabel=label)
        row[0].set_title(one.trial.name, loc="left", fontsize=9)
    for axis in axes[-1]:
        axis.set(xlabel="time, s")
    axes[0, 0].legend(fontsize=8)
    with writing(path, force=force) as part:
        figure.savefig(part, dpi=110, format="png")
    plt.close(figure)
