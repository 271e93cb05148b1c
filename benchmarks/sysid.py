"""`mujoco.sysid` on the logs of a rig with an effect that its model lacks, beside our diagnosis.

Two rigs: one has dry friction along the shaft that nobody modelled, the other (the
control) has nothing but more damping than believed. `mujoco.sysid` gets what its users
give it: a plain MuJoCo model, scales of damping and stiffness to find, residuals over
the noise that `rig.yaml` claims, its check of conditioning. It fits all trials together,
and then each of them alone. Where there is dry friction, a second fit is told of it.

Its residual is of the trials that it fitted, ours of trials left out: with thousands of
samples and two or three parameters the difference is small. Intervals are 95 %.

The packages of `mujoco.sysid` are an extra, `mujoco[sysid]`; without them it is skipped.
"""

import argparse
import contextlib
import importlib
import io
import logging
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from rich.markup import escape

from benchmarks import report, sysid_rig
from benchmarks.sysid_rig import TIP, TORQUE
from diagnosis.diagnose import diagnose
from diagnosis.report import as_json
from diagnosis.rig_log import Rig, RigLog, Trial, read_rig_log
from models import units
from models.errors import InvalidValue
from models.needle import Needle

SCALE, STIFFNESS, LEVEL = "damping_error.scale", "stiffness_error.scale", "coulomb_friction.level"
DRY, CONTROL = "dry friction", "damping alone"
TRUTH = {DRY: {SCALE: 1.0, STIFFNESS: 1.0, LEVEL: 0.0015}, CONTROL: {SCALE: 1.3, STIFFNESS: 1.0}}
LEVEL_BOUND, FLOOR_BOUND, AGREEMENT_BOUND, GAP_BOUND = 0.05, 1.05, 0.02, 2.0

# By name: checkers of types would take its `py.typed` for all of MuJoCo's.
sysid: Any = importlib.import_module("mujoco.sysid")

_UNIT = {SCALE: 1.0, STIFFNESS: 1.0, LEVEL: 1e-3}  # of a fit's parameter: all are of the order of 1
_RIG, _OURS, _SYSID, _TOLD = "the rig", "diagnosis", "mujoco.sysid", "sysid, told"
_COLUMNS = "residual over noise; scales of nominal; damping of each trial alone; dry torque"

_Interval = tuple[float, float, float]  # value, low, high


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What one of them made of a log.

    Attributes:
      intervals: value, low and high by `effect.parameter`, in the vocabulary's units.
      residual: root mean square over noise; 1 is the floor.
      alone: the damping scale of each trial by itself.
    """

    log: str
    by: str
    says: str
    intervals: dict[str, _Interval]
    residual: float
    alone: tuple[float, ...] = ()


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


def diagnosed(name: str, log: RigLog) -> Finding:
    """Our diagnosis."""
    found = as_json(diagnose(log))
    explanations = found["confusable"] or [found["effects"]]
    effects = " or ".join(" + ".join(names) for names in explanations)
    return Finding(
        log=name,
        by=_OURS,
        says=found["verdict"] + (f": {effects}" if effects else ""),
        intervals={
            f"{effect}.{parameter}": (v["value"], v["low"], v["high"])
            for effect, parameters in found["parameters"].items()
            for parameter, v in parameters.items()
        },
        residual=found["gap"]["after"],
    )


def _fit(name: str, rig: Rig, trials: Sequence[Trial], *, told: bool) -> Finding:
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
        by=_TOLD if told else _SYSID,
        says="; ".join(warnings) or "no warning",
        intervals={n: (v * _UNIT[n], (v - h) * _UNIT[n], (v + h) * _UNIT[n]) for n, v, h in values},
        residual=float(np.sqrt(np.mean(np.concatenate(residuals) ** 2))),
    )


def _parameters(rig: Rig, *, told: bool) -> Any:
    """Of the nominal rig; none starts at a bound, where the optimiser may stall."""
    rigidity = Needle(**dict(rig.needle), length_mm=1.0).rigidity_n_mm2 * units.N_MM2
    damping = rig.tissue.damping_n_mm_s_per_mm
    modifiers = {
        SCALE: lambda spec, p: sysid_rig.set_damping(spec, damping * p.value[0]),
        STIFFNESS: lambda spec, p: sysid_rig.set_rigidity(spec, rigidity * p.value[0]),
        LEVEL: lambda spec, p: sysid_rig.set_dry_torque(spec, _UNIT[LEVEL] * p.value[0]),
    }
    found = sysid.ParameterDict()
    for name in modifiers if told else (SCALE, STIFFNESS):
        found.add(sysid.Parameter(name, 1.0, 0.01, 20.0, modifier=modifiers[name]))
    return found


def _sequence(rig: Rig, trial: Trial) -> Any:
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


def _over_noise(rig: Rig) -> Any:
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


def _cell(finding: Finding, name: str) -> str:
    if name not in finding.intervals:
        return "-"
    value, low, high = (bound / _UNIT[name] for bound in finding.intervals[name])
    return f"{value:.3f}" + (f" ± {0.5 * (high - low):.3f}" if low < high else "")


def _row(finding: Finding) -> dict[str, Any]:
    alone = finding.alone
    return {
        "by": finding.by,
        "says": escape(finding.says),
        "residual, -": finding.residual,
        "damping, -": _cell(finding, SCALE),
        "alone, -": f"{min(alone):.2f}-{max(alone):.2f}" if alone else "-",
        "stiffness, -": _cell(finding, STIFFNESS),
        "dry, mN mm/mm": _cell(finding, LEVEL),
    }


def _long(finding: Finding) -> list[dict[str, Any]]:
    """One row a parameter, as numbers."""
    return [
        {"log": finding.log, "by": finding.by, "parameter": name, "value": v, "low": low, "high": high}
        for name, (v, low, high) in finding.intervals.items()
    ]


def _true(name: str) -> Finding:
    intervals = {n: (v, v, v) for n, v in TRUTH[name].items()}
    return Finding(log=name, by=_RIG, says="-", intervals=intervals, residual=1.0)


def _logs(folder: Path, given: Path | None) -> dict[str, RigLog]:
    """By name: the log that is given, or those of the two rigs, made here."""
    if given is not None:
        return {given.name: _replayable(read_rig_log(given))}
    made = {}
    for name, truth in TRUTH.items():
        effects = {key.split(".")[0]: {key.split(".")[1]: value} for key, value in truth.items()}
        made[name] = read_rig_log(sysid_rig.write_log(folder / name.replace(" ", "-"), effects))
    return made


def _replayable(log: RigLog) -> RigLog:
    """The trials that both can take; says which it leaves out."""
    reasons = {trial.name: sysid_rig.unfit(trial) for trial in log.trials}
    for name, reason in reasons.items():
        if reason:
            report.say(f"{name} is left out: {reason}")
    trials = tuple(trial for trial in log.trials if not reasons[trial.name])
    if not trials:
        raise InvalidValue(
            "--log", "no such trial", "a trial with constant lengths and complete sensors"
        )
    return replace(log, trials=trials)


def _findings(name: str, log: RigLog) -> list[Finding]:
    """The truth, where it is known, and what each makes of the log."""
    truth = [_true(name)] if name in TRUTH else []
    dry = name not in TRUTH or LEVEL in TRUTH[name]
    return [*truth, diagnosed(name, log), identified(name, log), *([told(name, log)] if dry else [])]


def _goals(findings: Sequence[Finding]) -> list[report.Goal]:
    """What the comparison is to show; not measured where a log was given, or all was skipped."""
    by = {(f.log, f.by): f for f in findings}

    def value(log: str, who: str, name: str) -> float:
        finding = by.get((log, who))
        # Not having found what is there is the largest error.
        return math.nan if finding is None else finding.intervals.get(name, (math.inf,))[0]

    def residual(log: str, who: str) -> float:
        return by[log, who].residual if (log, who) in by else math.nan

    level = value(DRY, _OURS, LEVEL) / TRUTH[DRY][LEVEL]
    agreement = value(CONTROL, _OURS, SCALE) / value(CONTROL, _SYSID, SCALE)
    return [
        report.Goal(name=f"{DRY}: our error of its level", measured=abs(level - 1), bound=LEVEL_BOUND),
        report.Goal(
            name=f"{DRY}: our residual / noise", measured=residual(DRY, _OURS), bound=FLOOR_BOUND
        ),
        report.Goal(
            name=f"{DRY}: residual / noise of mujoco.sysid",
            measured=residual(DRY, _SYSID),
            bound=GAP_BOUND,
            at_least=True,
        ),
        report.Goal(
            name=f"{CONTROL}: our scale over that of mujoco.sysid, less 1",
            measured=abs(agreement - 1),
            bound=AGREEMENT_BOUND,
        ),
    ]


def run(folder: Path, given: Path | None = None) -> list[report.Goal]:
    """Measure, print, write; or say why not."""
    reason = missing()
    if reason:
        report.say(escape(f"mujoco.sysid: skipped; {reason}"))
        return _goals([])
    logs = _logs(folder / "sysid-logs", given)
    findings: list[Finding] = []
    for name, log in logs.items():
        mine = _findings(name, log)
        rows = [_row(finding) for finding in mine]
        report.show(f"{name}: {_COLUMNS}", rows, folder, f"sysid_{name.replace(' ', '_')}")
        findings += mine
    report.write_csv([row for finding in findings for row in _long(finding)], folder, "sysid_parameters")
    return _goals(findings)


def add_option(parser: argparse.ArgumentParser) -> None:
    """`--log`."""
    parser.add_argument("--log", type=Path, help="a rig-log folder, instead of our own two")


def main() -> None:
    """The comparison alone."""
    parser = report.parser(__doc__)
    add_option(parser)
    options = parser.parse_args()
    report.show_goals(run(Path(options.out), options.log), Path(options.out))


if __name__ == "__main__":
    main()
