"""The plots: every signal of a recording that has a plot, and modal amplitudes."""

import pandas as pd

from sim.recording import rerun_plots
from sim.recording.recording import Recording
from sim.recording.rerun_plots import log_modes, log_plots


def logged(monkeypatch):
    """Paths of the lines that are logged from now on."""
    paths = []
    monkeypatch.setattr(rerun_plots, "log_series", lambda stream, path, *_: paths.append(path))
    return paths


def test_signals_are_logged_in_their_plots_and_others_are_not(monkeypatch):
    paths = logged(monkeypatch)
    table = pd.DataFrame({"time_s": [0.0], "tip_angle_deg": [1.0], "speed_mm_s": [0.0], "x_mm": [2.0]})
    log_plots(None, table)
    assert paths == ["angles/tip_angle_deg", "speed/speed_mm_s"]


def test_modes_of_an_estimator_are_logged_beside_those_of_the_shaft(recording, monkeypatch):
    paths = logged(monkeypatch)
    shaftless = recording.table[[c for c in recording.table if not c.startswith("shaft_0")]]
    table = shaftless.assign(estimate_mode_1_deg=0.0, estimate_mode_2_deg=0.0)
    log_modes(None, Recording(table=table, parameters=recording.parameters))
    assert paths == ["estimate/1", "estimate/2"]
