"""A log in `mujoco.sysid`: residuals over the claimed noise, scales of damping and stiffness to find.

`mujoco.sysid` gets what its users give it: the plain model of `benchmarks.sysid_rig`, the
measured base angle as input, and its check of conditioning. Intervals are 95 %.
"""

import contextlib
import importlib
import io
import logging
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from benchmarks import sysid_rig
from benchmarks.sysid_rig import TIP, TORQUE
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial
from models import units
from models.needle import Needle

SCALE, STIFFNESS, LEVEL = "damping_error.scale", "stiffness_error.scale", "coulomb_friction.level"
UNIT = {SCALE: 1.0, STIFFNESS: 1.0, LEVEL: 1e-3}  # of a fit's parameter: all are of the order of 1
UNTOLD, TOLD = "mujoco.sysid", "sysid, told"

# By name: checkers of types would take its `py.typed` for all of MuJoCo's.
sysid: Any = importlib.import_module("mujoco.sysid")


@dataclass(frozen=True, kw_only=True)
class Finding:
    """The result of one program for a log.

    Attributes:
      intervals: value, low and high by `effect.parameter`, in the vocabulary's units.
      residual: root mean square of residual / sigma; 1 is the floor.
      alone: the damping scale of each trial by itself.
      cpu_s: of the process and its workers that have ended.
    """

    log: str
    by: str
    says: str
    intervals: dict[str, tuple[float, float, float]]
    residual: float
    alone: tuple[float, ...] = ()
    cpu_s: float = math.nan


def missing() -> str:
    """Why `mujoco.sysid` cannot run; empty if it can. Without its extra it imports, and is empty."""
    if hasattr(sysid, "default_report"):
        return ""
    return "its packages are not installed; `pip install 'mujoco[sysid]'` brings them"


def identified(name: str, log: RigLog) -> Finding:
    """Scales of damping and stiffness by `mujoco.sysid`, from all trials and from each."""
    found = _fit(name, log.rig, log.trials, told=False)
    alone = [_fit(name, log.rig, [trial], told=False).intervals[SCALE][0] for trial in log.trials]
    return replace(found, alone=tuple(alone))


def told(name: str, log: RigLog) -> Finding:
    """The same where its user knows of the dry friction: MuJoCo's friction loss is a parameter."""
    return _fit(name, log.rig, log.trials, told=True)


def _fit(name: str, rig: NominalRig, trials: Sequence[Trial], *, told: bool) -> Finding:
    start = _parameters(rig, told=told)
    residual_of = sysid.build_residual_fn(
        models_sequences=[_sequence(rig, trial) for trial in trials],
        modify_residual=_over_noise(rig).apply,
        n_threads=1,
    )
    with _warnings() as warnings:
        found, result = sysid.optimize(start, residual_of, verbose=False, check_conditioning=True)
    warnings += _insights(found)
    residuals, _, _ = residual_of(found.as_vector(), found)
    _, halves = sysid.calculate_intervals(residuals, result.jac)
    values = zip(found.keys(), found.as_vector().tolist(), halves.tolist(), strict=True)
    return Finding(
        log=name,
        by=TOLD if told else UNTOLD,
        says="; ".join(warnings) or "no warning",
        intervals={n: (v * UNIT[n], (v - h) * UNIT[n], (v + h) * UNIT[n]) for n, v, h in values},
        residual=float(np.sqrt(np.mean(np.concatenate(residuals) ** 2))),
    )


def _parameters(rig: NominalRig, *, told: bool) -> Any:
    """Of the nominal rig; none starts at a bound, where the optimiser may stall."""
    rigidity = Needle(**dict(rig.needle), length_mm=1.0).rigidity_n_mm2 * units.N_MM2
    damping = rig.tissue.damping_n_mm_s_per_mm
    modifiers = {
        SCALE: lambda spec, p: sysid_rig.set_damping(spec, damping * p.value[0]),
        STIFFNESS: lambda spec, p: sysid_rig.set_rigidity(spec, rigidity * p.value[0]),
        LEVEL: lambda spec, p: sysid_rig.set_dry_torque(spec, UNIT[LEVEL] * p.value[0]),
    }
    found = sysid.ParameterDict()
    for name in modifiers if told else (SCALE, STIFFNESS):
        found.add(sysid.Parameter(name, 1.0, 0.01, 20.0, modifier=modifiers[name]))
    return found


def _sequence(rig: NominalRig, trial: Trial) -> Any:
    """A trial as `mujoco.sysid` takes it: model, input, and what the sensors read."""
    spec = sysid_rig.plain_spec(rig, trial)
    model = spec.compile()
    time = trial["time_s"] - trial["time_s"][0]
    read = np.column_stack([trial[TIP] * units.DEG, trial[TORQUE] * units.N_MM])
    whole = np.isfinite(read).all(axis=1)
    return sysid.ModelSequences(
        trial.name,
        spec,
        "measured",
        sysid.create_initial_state(model, np.zeros(model.nq)),
        sysid.TimeSeries(time, trial["base_angle_deg"][:, None] * units.DEG),
        sysid.TimeSeries.from_names(time[whole], read[whole], model),
    )


def _over_noise(rig: NominalRig) -> Any:
    """Residuals over the claimed noise; by default they are over the signals' size."""
    transform = sysid.SignalTransform(normalize=False)
    tip = rig.sensors.tip_angle_noise_deg * units.DEG
    torque = rig.sensors.base_torque_noise_n_mm * units.N_MM
    transform.set_sensor_weights({TIP: 1 / tip, TORQUE: 1 / torque})
    return transform


@contextlib.contextmanager
def _warnings() -> Iterator[list[str]]:
    """What is logged as a warning; the optimiser's progress goes nowhere."""
    heard: list[str] = []
    handler = logging.Handler(logging.WARNING)
    handler.emit = lambda record: heard.append(record.getMessage())  # type: ignore[method-assign]
    logger = logging.getLogger("absl")
    logger.addHandler(handler)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            yield heard
    finally:
        logger.removeHandler(handler)


def _insights(found: Any) -> list[str]:
    """The warnings that its report would have."""
    section = importlib.import_module("mujoco.sysid.report.sections.insights")
    insights = section.AutomatedInsights("", found).get_context()["insights"]
    return [insight["title"] for insight in insights if insight["type"] == "warning"]
