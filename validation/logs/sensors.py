"""From ideal signals to the rows of a log: noise, quantisation, lost samples."""

import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.logs.profiles import log_uniform
from validation.rig.motion import TrialMotion
from validation.rig.rig import IndependentRig
from validation.rig.unmodelled.effect import IdealSignals

Array = NDArray[np.float64]
TIP, TORQUE, BASE = "tip_angle_deg", "base_torque_n_mm", "base_angle_deg"
MEASURED = (TIP, TORQUE)
FORMATS = {TORQUE: "%.4f", "tip_torque_n_mm": "%.4f"}
"""Other columns have three decimals."""
FINE_TIME = FORMATS | {"time_s": "%.5f"}
"""Of logs whose time stamps are no whole milliseconds."""


@dataclass(frozen=True, kw_only=True)
class LogSensors:
    """The sensors of one log.

    Attributes:
      noise: standard deviation (sigma) per signal, in the unit of its column.
      claims: noise stated in rig.yaml / true noise.
      steps: quantisation step / noise, for quantised signals.
      dropped: share of rows that are lost at random; `gaps`: also gaps of some tenths of a second.
      missing: a column that does not exist; `blank`: one with a stretch of empty cells.
    """

    noise: dict[str, float]
    claims: dict[str, float]
    steps: dict[str, float]
    dropped: float = 0.0
    gaps: bool = False
    missing: str = ""
    blank: str = ""

    @property
    def shown(self) -> tuple[str, ...]:
        """Measured signals that the log has."""
        return tuple(signal for signal in MEASURED if signal != self.missing)

    def details(self) -> dict[str, Any]:
        """Every attribute that is not neutral, for the ground truth."""
        return {name: value for name, value in asdict(self).items() if value}


def draw_sensors(rng: np.random.Generator) -> LogSensors:
    """Draw sensors: most are plain; each defect is rare, and several may occur together."""
    noise = {TIP: log_uniform(rng, 0.2, 0.6), TORQUE: log_uniform(rng, 0.01, 0.02), BASE: 0.02}
    claims = {signal: rng.uniform(0.87, 1.15) for signal in noise}
    defect = rng.random(5) < (0.06, 0.15, 0.15, 0.05, 0.04)
    if defect[0]:
        claims[str(rng.choice(MEASURED))] *= rng.choice([1 / 3, 3.0])
    steps = {signal: rng.uniform(0.5, 1.0) for signal in rng.choice(MEASURED, rng.integers(1, 3), False)}
    column = str(rng.choice(MEASURED))
    return LogSensors(
        noise=noise,
        claims=claims,
        steps={str(signal): float(step) for signal, step in steps.items()} if defect[1] else {},
        dropped=rng.uniform(0.005, 0.05) if defect[2] else 0.0,
        gaps=bool(defect[2] and rng.random() < 0.5),
        missing=column if defect[3] else "",
        blank=column if defect[4] and not defect[3] else "",
    )


def plain(sensors: LogSensors) -> LogSensors:
    """Sensors with the same noise, claims within 15 %, and no defect."""
    claims = {signal: min(max(claim, 0.87), 1.15) for signal, claim in sensors.claims.items()}
    return LogSensors(noise=sensors.noise, claims=claims, steps={})


def channels(motion: TrialMotion, ideal: IdealSignals) -> dict[str, Array]:
    """The columns of a trial's CSV on the fine grid, in their order."""
    shown = {
        "time_s": motion.time_s,
        BASE: ideal.base_deg,
        TORQUE: ideal.torque_n_mm,
        TIP: ideal.tip_deg,
        "inserted_mm": motion.inserted_mm,
        "free_mm": motion.free_mm,
        "speed_mm_s": motion.speed_mm_s,
    }
    load = motion.tip_torque_n_mm
    return shown if load is None else shown | {"tip_torque_n_mm": load}


def measure(
    rng: np.random.Generator, sensors: LogSensors, motion: TrialMotion, ideal: IdealSignals
) -> dict[str, Array]:
    """The columns of a trial's CSV as measured, in their order."""
    columns = {name: values[motion.recorded] for name, values in channels(motion, ideal).items()}
    for signal in (BASE, TORQUE, TIP):
        noisy = columns[signal] + rng.normal(0, sensors.noise[signal], columns[signal].size)
        step = sensors.steps.get(signal, 0.0) * sensors.noise[signal]
        columns[signal] = np.round(noisy / step) * step if step else noisy
    return _drop_samples(rng, sensors, columns)


def _drop_samples(
    rng: np.random.Generator, sensors: LogSensors, columns: dict[str, Array]
) -> dict[str, Array]:
    """Remove lost rows, blank cells and missing columns. The first row is always kept."""
    time_s = columns["time_s"]
    kept = rng.random(time_s.size) >= sensors.dropped
    if sensors.gaps:
        for start_s in rng.uniform(0.1, time_s[-1] - 0.4, int(rng.integers(1, 3))):
            kept &= (time_s < start_s) | (time_s > start_s + rng.uniform(0.1, 0.3))
    kept[0] = True
    if sensors.blank:
        start, length = rng.uniform(0.0, 0.6), rng.uniform(0.1, 0.3)
        share = time_s / time_s[-1]
        columns[sensors.blank][(share >= start) & (share < start + length)] = np.nan
    return {name: values[kept] for name, values in columns.items() if name != sensors.missing}


def as_csv(columns: dict[str, Array], formats: Mapping[str, str] = FORMATS) -> str:
    """A CSV with a header; cells without a number stay empty."""
    cells = [
        ["" if np.isnan(value) else formats.get(name, "%.3f") % value for value in values]
        for name, values in columns.items()
    ]
    lines = [",".join(columns), *map(",".join, zip(*cells, strict=True))]
    return re.sub(r"-(0\.0+)(?=[,\n])", r"\1", "\n".join(lines) + "\n")


def rig_yaml(sensors: LogSensors, rig: IndependentRig, trials: int) -> str:
    """The nominal rig, as the experimenter states it."""
    claimed = {name: f"{noise * sensors.claims[name]:.3g}" for name, noise in sensors.noise.items()}
    lines = [
        "format: rig-log/1",
        "needle:",
        f"  diameter_mm: {rig.diameter_mm}",
        f"  shear_modulus_gpa: {rig.shear_modulus_gpa}",
        "  density_g_cm3: 6.45",
        "tissue:",
        f"  damping_n_mm_s_per_mm: {rig.damping_n_mm_s_per_mm}",
        "sensors:",
        f"  tip_angle_noise_deg: {claimed[TIP]}",
        f"  base_torque_noise_n_mm: {claimed[TORQUE]}",
        f"  base_angle_noise_deg: {claimed[BASE]}",
        "trials:",
        *(f"  - file: trial_{i + 1:02d}.csv" for i in range(trials)),
    ]
    return "\n".join(lines) + "\n"
