"""The residual on the needle: a side stream for rerun.

Two needles lie side by side, the nominal above the explained. The chuck is coloured
by the residual of the base torque, the tip by that of its angle, each
averaged over a tenth of a second: grey at the noise, red at five times that.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from diagnosis.log.trial import Trial
from sim.recording.rerun_series import time_column

Array = NDArray[np.float64]

_ROWS = {"nominal": 0.0, "explained": 20.0}  # mm apart in the picture
_EVERY_S = 0.1
_RED_AT = 5.0
_GREY, _RED = np.array([170.0, 170.0, 170.0]), np.array([214.0, 39.0, 40.0])
_SHAFT, _TISSUE = (90, 90, 90), (205, 160, 110)
_RADIUS_MM = 4.0


def log_needle(
    stream: Any, entity: str, trial: Trial, residuals: Mapping[tuple[str, str], Array]
) -> None:
    """Log both needles of a trial; `residuals` are in sigma, by prediction and sensor."""
    time = trial["time_s"]
    width = max(1, round(_EVERY_S / float(np.median(np.diff(time)))))
    shown = np.arange(0, time.size, width)
    entry, tip = trial["free_mm"][shown], trial["free_mm"][shown] + trial["inserted_mm"][shown]
    for name, row in _ROWS.items():
        level, chuck = np.full(shown.size, row), np.zeros(shown.size)
        free, inserted = _strips(chuck, entry, level), _strips(entry, tip, level)
        stamps = [time_column(time[shown])]
        for part, strips, colour in (("free", free, _SHAFT), ("inserted", inserted, _TISSUE)):
            columns = rr.LineStrips2D.columns(
                strips=list(strips), colors=np.tile(colour, (shown.size, 1))
            )
            stream.send_columns(f"{entity}/{name}/{part}", indexes=stamps, columns=columns)
        for sensor, at in (("base_torque_n_mm", chuck), ("tip_angle_deg", tip)):
            if (name, sensor) in residuals:
                columns = rr.Points2D.columns(
                    positions=np.stack([at, level], axis=-1),
                    colors=_colours(residuals[name, sensor], shown),
                    radii=np.full(shown.size, _RADIUS_MM),
                )
                stream.send_columns(f"{entity}/{name}/{sensor}", indexes=stamps, columns=columns)


def needle_bounds(trial: Trial) -> Any:
    """What a view of both needles has to show."""
    longest, margin = float((trial["free_mm"] + trial["inserted_mm"]).max()), 2 * _RADIUS_MM
    rows = [-margin, max(_ROWS.values()) + margin]
    return rrb.VisualBounds2D(x_range=[-margin, longest + margin], y_range=rows)


def _strips(start: Array, end: Array, level: Array) -> Array:
    """(N, 2, 2): from start to end at a level of the picture."""
    return np.stack([np.stack([start, level], -1), np.stack([end, level], -1)], axis=1)


def _colours(residuals: Array, shown: NDArray[np.int_]) -> NDArray[np.uint8]:
    """Of the means over the samples from each that is shown to the next, (N, 3)."""
    counts = np.diff(np.append(shown, residuals.size))
    size = np.abs(np.add.reduceat(residuals, shown)) / np.sqrt(counts)
    share = np.clip((size - 1.0) / (_RED_AT - 1.0), 0.0, 1.0)[:, None]
    return np.asarray(_GREY + share * (_RED - _GREY), np.uint8)
