"""Reading `rig-log/1`: a folder with `rig.yaml` and one CSV per trial.

Unusable data are an error that says how to fix it; doubtful data are used or left out
with a warning. The files are never changed.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from diagnosis.log.checks.angle_wraps import refuse_wraps
from diagnosis.log.checks.heavy_shaft import heavy_shaft_warnings, refuse_kg_m3
from diagnosis.log.checks.lengths import refuse_impossible_lengths
from diagnosis.log.checks.noise_claims import far_claims
from diagnosis.log.checks.plausibility import plausibility_warnings
from diagnosis.log.checks.repeated_trials import refuse_repeated_trials
from diagnosis.log.checks.time_scale import lag_warnings
from diagnosis.log.checks.torque_scale import torque_warnings
from diagnosis.log.contradictions.consistency import refuse_contradictions
from diagnosis.log.contradictions.other_units import refuse_other_units
from diagnosis.log.faults.mains_hum import without_hum
from diagnosis.log.faults.saturated import ends_of_ranges
from diagnosis.log.faults.sensor_faults import without_faults
from diagnosis.log.faults.smoothed import smoothed_above_hz
from diagnosis.log.faults.twist_beyond import without_twist_beyond
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.rig_yaml import read_rig
from diagnosis.log.times.even_times import with_even_times
from diagnosis.log.times.sampling_jitter import with_sampling_times
from diagnosis.log.times.slow_sensors import with_new_readings
from diagnosis.log.trial import SENSORS, TIP, Trial, UnusableLog
from diagnosis.log.trial_file import read_trial, refuse_too_large


@dataclass(frozen=True, kw_only=True)
class RigLog:
    """A rig's log: the nominal rig and its trials.

    Attributes:
      rig: the nominal rig, with the noise of samples.
      warnings: what is doubtful, and what was done about it.
      name: name of its folder; empty: it was not read from one.
      means_of: number of readings that a sample is the mean of.
      smoothed_above_hz: corner of the filter by which readings were smoothed, by sensor.
      noise_left: noise in their low band / that of a reading, by sensor; 1 for others.
      as_read: the nominal rig as rig.yaml states it, where samples are no single readings; None: `rig`.
    """

    rig: NominalRig
    trials: tuple[Trial, ...]
    warnings: tuple[str, ...] = ()
    name: str = ""
    means_of: int = 1
    smoothed_above_hz: Mapping[str, float] = field(default_factory=dict)
    noise_left: Mapping[str, float] = field(default_factory=dict)
    as_read: NominalRig | None = None

    @property
    def stated_rig(self) -> NominalRig:
        """The nominal rig as rig.yaml states it."""
        return self.as_read or self.rig


def read_rig_log(folder: Path) -> RigLog:
    """Read and check a log.

    Raises:
      UnusableLog: names the file, the line or column, and how to fix it.
    """
    rig = read_rig(folder / "rig.yaml")
    refuse_kg_m3(folder / "rig.yaml", rig.needle)
    noise = rig.sensors.by_column()
    paths = [folder / entry.file for entry in rig.trials]
    refuse_too_large(paths)
    read = [_readable(path, rig) for path in paths]
    new, slow = with_new_readings(read, noise)
    even, warnings = with_even_times(new)
    timed, jittered = with_sampling_times(even)
    warnings, trials = [*slow, *warnings, *jittered], list[Trial]()
    ends = ends_of_ranges(timed, noise)
    for path, one in zip(paths, timed, strict=True):
        trial, found = without_faults(one, noise, ends)
        refuse_contradictions(path, trial, noise, rig.rigidity_n_mm2)
        trial, twisted = without_twist_beyond(trial, rig.rigidity_n_mm2, noise[TIP])
        warnings += [*found, *twisted]
        trials.append(trial)
    trials, hums = without_hum(trials, noise)
    warnings += hums
    refuse_repeated_trials(paths, trials)
    refuse_other_units(paths, trials, noise)
    if not any(trial.has(sensor) for trial in trials for sensor in SENSORS):
        raise UnusableLog(
            f"{folder}: expected readings of {' or '.join(SENSORS)} in one trial at least, found none "
            f"that can be used; add the column; {'; '.join(warnings)[:400]}"
        )
    damping = rig.tissue.damping_n_mm_s_per_mm
    smoothed, filtered = smoothed_above_hz(trials, noise)
    rough = {column: claim for column, claim in noise.items() if column not in smoothed}
    warnings += [
        *heavy_shaft_warnings(rig.needle),
        *filtered,
        *far_claims(_as_read(new, read), rough).values(),
        *torque_warnings(trials, noise, rig.rigidity_n_mm2, damping),
        *lag_warnings(trials, rig.rigidity_n_mm2, damping),
        *plausibility_warnings(trials, noise),
    ]
    return RigLog(
        rig=rig,
        trials=tuple(trials),
        warnings=tuple(warnings),
        name=folder.resolve().name,
        smoothed_above_hz=smoothed,
    )


def _as_read(trials: Sequence[Trial], read: Sequence[Trial]) -> list[Trial]:
    """The trials with the base as it was read: a curve in place of readings scatters less."""
    base = "base_angle_deg"
    return [
        replace(trial, table=trial.table.assign(**{base: own[base]}))
        for trial, own in zip(trials, read, strict=True)
    ]


def files_of(log: RigLog, folder: Path) -> tuple[Path, ...]:
    """The files that a log was read from."""
    return (folder / "rig.yaml", *(folder / entry.file for entry in log.rig.trials))


def _readable(path: Path, rig: NominalRig) -> Trial:
    """Read a trial, and refuse what cannot be a trial of the rig."""
    trial = read_trial(path)
    refuse_wraps(path, trial)
    refuse_impossible_lengths(path, trial, rig.needle.diameter_mm)
    return trial
