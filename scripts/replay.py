"""`needle replay`: a rig's log beside what the nominal needle predicts."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rich.console import Console
from rich.table import Table

from diagnosis.replay import Replay, replay
from diagnosis.rig_log import SENSORS, RigLog, read_rig_log
from sim.files import refuse_existing, writing
from sim.recording.recording import record
from sim.recording.rerun_log import log_recording

_NOISE = {"tip_angle_deg": "tip_angle_noise_deg", "base_torque_n_mm": "base_torque_noise_n_mm"}


def run(log_folder: Path, folder: Path, *, force: bool, console: Console) -> int:
    """Replay every trial; writes predictions, a picture and a recording of the first."""
    log = read_rig_log(log_folder)
    paths = output_paths(log, folder)
    refuse_existing(paths, force=force)
    with console.status(f"replaying {len(log.trials)} trials"):
        replays = replay(log)
    console.print(table(log, replays))
    write(log, replays, folder, force=force)
    for path in paths:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """What `write` will write."""
    predictions = [folder / "predictions" / trial.name for trial in log.trials]
    return [folder / "replay.png", folder / "replay.rrd", *predictions]


def gap(log: RigLog, one: Replay, sensor: str) -> float:
    """Root mean square of the residual over the claimed noise; NaN if not measured."""
    noise = getattr(log.rig.sensors, _NOISE[sensor])
    if not one.trial.has(sensor) or noise == 0:
        return float("nan")
    return float(np.sqrt(np.nanmean(one.residual(sensor) ** 2)) / noise)


def table(log: RigLog, replays: list[Replay]) -> Table:
    """The gap of each trial, in units of the noise that the log claims."""
    shown = Table(
        "trial", "samples", "tip", "base torque", title="Gap to the nominal model, in noise units"
    )
    for one in replays:
        gaps = [gap(log, one, sensor) for sensor in ("tip_angle_deg", "base_torque_n_mm")]
        cells = ["not measured" if np.isnan(g) else f"{g:.2f}" for g in gaps]
        shown.add_row(one.trial.name, str(len(one.trial.table)), *cells)
    return shown


def write(log: RigLog, replays: list[Replay], folder: Path, *, force: bool) -> None:
    """Predictions as CSV, residuals as a picture, the first trial as a recording."""
    picture, rrd, *predictions = output_paths(log, folder)
    for one, path in zip(replays, predictions, strict=True):
        columns = {"time_s": one.trial["time_s"]}
        columns |= {f"{name}_nominal": one.predicted[name] for name in SENSORS}
        with writing(path, force=force) as part:
            pd.DataFrame(columns).to_csv(part, index=False, float_format="%.6g")
    _draw(replays, picture, force=force)
    first = replays[0]
    results = [f"gap, {s}: {gap(log, first, s):.2f} noise" for s in SENSORS]
    parameters = {"protocol": first.trial.name, "description": "the nominal needle on a rig's motion"}
    log_recording(record(first.run, parameters), rrd, results=results, force=force)


def _draw(replays: list[Replay], path: Path, *, force: bool) -> None:
    size = (11, 2.2 * len(replays) + 1)
    figure, axes = plt.subplots(len(replays), 2, figsize=size, layout="constrained", squeeze=False)
    labels = ("tip, deg", "base torque, N mm")
    for row, one in zip(axes, replays, strict=True):
        for axis, sensor, label in zip(row, ("tip_angle_deg", "base_torque_n_mm"), labels, strict=True):
            if one.trial.has(sensor):
                axis.plot(one.trial["time_s"], one.trial[sensor], color="0.6", lw=0.8, label="measured")
            axis.plot(one.trial["time_s"], one.predicted[sensor], color="tab:red", lw=1, label="nominal")
            axis.set(ylabel=label)
        row[0].set_title(one.trial.name, loc="left", fontsize=9)
    for axis in axes[-1]:
        axis.set(xlabel="time, s")
    axes[0, 0].legend(fontsize=8)
    with writing(path, force=force) as part:
        figure.savefig(part, dpi=110, format="png")
    plt.close(figure)
