"""The nominal rig and the trials, as the log has them."""

from collections.abc import Iterator

import numpy as np

from diagnosis.log.trial import SENSORS, Trial
from diagnosis.report import html_parts as html
from diagnosis.result import Diagnosis
from models.record import Record

_RIG = "The constants of the rig in rig.yaml, which make the nominal model."


def rig_section(found: Diagnosis) -> list[str]:
    """Everything under this heading."""
    return [
        html.heading("The rig and its trials"),
        html.paragraph(_RIG),
        html.table(("constant", "value"), _constants(found), "Constants of rig.yaml"),
        html.table(
            ("trial", "duration, s", "samples", "inserted, mm", "free, mm", "speed, mm/s", "measured"),
            [_trial(trial) for trial in found.log.trials],
            "Trials",
        ),
    ]


def _constants(found: Diagnosis) -> Iterator[tuple[str, str]]:
    for group, record in dict(found.log.stated_rig).items():
        if isinstance(record, Record):
            yield from ((f"{group}.{name}", f"{value:g}") for name, value in dict(record).items())


def _trial(trial: Trial) -> tuple[str, ...]:
    measured = ", ".join(sensor for sensor in SENSORS if trial.has(sensor)) or "nothing"
    lengths = (_range(trial, name) for name in ("inserted_mm", "free_mm", "speed_mm_s"))
    time = trial["time_s"]
    return (
        trial.name,
        f"{time[-1] - time[0]:.1f}",
        str(trial.file_rows.stamps_s.size),
        *lengths,
        measured,
    )


def _range(trial: Trial, column: str) -> str:
    low, high = float(np.nanmin(trial[column])), float(np.nanmax(trial[column]))
    return f"{low:.4g}" if f"{low:.4g}" == f"{high:.4g}" else f"{low:.4g} to {high:.4g}"
