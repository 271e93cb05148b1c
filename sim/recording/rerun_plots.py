"""The plots of a recording in rerun: all signals with names and colours, and modal amplitudes.

Output only: nothing that computes imports this module.
"""

import numpy as np
import pandas as pd
import rerun as rr
from matplotlib import colormaps

from sim.recording.modal_amplitudes import MODES, modal_amplitudes_deg
from sim.recording.recording import Recording
from sim.recording.rerun_series import Array, log_series

_PLOTS: dict[str, dict[str, tuple[str, list[int]]]] = {
    "angles": {
        "base_angle_deg": ("base", [90, 90, 90]),
        "tip_angle_deg": ("tip", [214, 39, 40]),
        "estimate_tip_deg": ("tip, estimated", [255, 127, 14]),
        "wanted_tip_deg": ("tip, wanted", [44, 160, 44]),
        "command_base_deg": ("base, commanded", [31, 119, 180]),
        "measured_base_deg": ("base, measured", [150, 150, 150]),
        "measured_tip_deg": ("tip, measured", [255, 152, 150]),
        "closed_form_tip_deg": ("tip, closed form", [44, 160, 44]),
        "native_tip_deg": ("tip, needle without callbacks", [148, 103, 189]),
    },
    "torque": {
        "base_torque_n_mm": ("base torque", [31, 119, 180]),
        "friction_n_mm": ("friction of the tissue", [148, 103, 189]),
        "tip_torque_n_mm": ("torque at the tip", [214, 39, 40]),
        "measured_torque_n_mm": ("base torque, measured", [158, 202, 225]),
        "estimate_bias_n_mm": ("bias of the sensor, estimated", [255, 127, 14]),
    },
    "limits": {
        "rate_limited_count": ("at the motor's rate", [188, 189, 34]),
        "torque_limited_count": ("at the motor's torque", [227, 119, 194]),
    },
    "lengths": {
        "inserted_mm": ("inserted", [140, 86, 75]),
        "free_mm": ("free", [127, 127, 127]),
    },
    "speed": {"speed_mm_s": ("into the tissue", [140, 86, 75])},
    "energy": {
        "drive_work_mj": ("work of the drive", [31, 119, 180]),
        "dissipated_mj": ("dissipated", [148, 103, 189]),
        "torsion_energy_mj": ("stored in the shaft", [140, 86, 75]),
        "tissue_energy_mj": ("stored in the tissue", [44, 160, 44]),
    },
    "stress": {"shear_stress_mpa": ("largest in the shaft", [214, 39, 40])},
    "solver": {
        "newton_iterations_count": ("iterations of the step", [31, 119, 180]),
        "unconverged_count": ("stages that did not converge, so far", [214, 39, 40]),
    },
    "correction": {"correction_n_mm": ("correction to second order", [127, 127, 127])},
}


def log_plots(stream: rr.RecordingStream, table: pd.DataFrame) -> None:
    """Log every signal of a table that belongs to a plot."""
    time_s = np.asarray(table["time_s"], float)
    for plot, signals in _PLOTS.items():
        for name, (label, colour) in signals.items():
            if name in table:
                values = np.asarray(table[name], float)
                log_series(stream, f"{plot}/{name}", label, time_s, values, colour)


def log_modes(stream: rr.RecordingStream, recording: Recording) -> None:
    """Log the amplitudes of the closed form's modes, and those of an estimator if there is one."""
    amplitudes = modal_amplitudes_deg(recording)
    if amplitudes is not None:
        for k in range(MODES):
            _log_mode(stream, "modes", k, recording["time_s"], amplitudes[:, k])
    names = [str(n) for n in recording.table.columns if str(n).startswith("estimate_mode_")]
    for k, name in enumerate(names):
        _log_mode(stream, "estimate", k, recording["time_s"], recording[name])


def _log_mode(stream: rr.RecordingStream, plot: str, k: int, time_s: Array, values: Array) -> None:
    colour = (np.array(colormaps["Set2"](k % 8))[:3] * 255).astype(int).tolist()
    log_series(stream, f"{plot}/{k + 1}", f"mode {k + 1}", time_s, values, colour)
