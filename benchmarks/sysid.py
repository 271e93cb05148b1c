"""`mujoco.sysid` on the logs of a rig with an effect that its model lacks, beside our diagnosis.

Two rigs: one has dry friction along the shaft that nobody modelled, the other (the
control) has nothing but more damping than believed. `mujoco.sysid` (`benchmarks.sysid_fit`)
fits all trials together, and then each of them alone. Where there is dry friction, a
second fit is told of it.

Its residual is of the trials that it fitted, ours of trials left out: with thousands of
samples and two or three parameters the difference is small.

The packages of `mujoco.sysid` are an extra, `mujoco[sysid]`; without them it is skipped.
"""

import argparse
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from rich.markup import escape

from benchmarks import report, sysid_fit, sysid_rig
from benchmarks.diagnosis import used_cpu_s
from benchmarks.sysid_fit import LEVEL, SCALE, STIFFNESS, UNIT, UNTOLD, Finding
from diagnosis.log.rig_log import RigLog, read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from models.errors import InvalidValue

DRY, CONTROL = "dry friction", "damping alone"
TRUTH = {DRY: {SCALE: 1.0, STIFFNESS: 1.0, LEVEL: 0.0015}, CONTROL: {SCALE: 1.3, STIFFNESS: 1.0}}
LEVEL_BOUND, FLOOR_BOUND, AGREEMENT_BOUND, GAP_BOUND = 0.05, 1.05, 0.02, 2.0

_RIG, _OURS = "the rig", "diagnosis"
_COLUMNS = "residual / sigma; scales of nominal; damping of each trial alone; dry torque"


def diagnosed(name: str, log: RigLog) -> Finding:
    """The result of our diagnosis."""
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


def _cell(finding: Finding, name: str) -> str:
    if name not in finding.intervals:
        return "-"
    value, low, high = (bound / UNIT[name] for bound in finding.intervals[name])
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
            "--log", "none", "a log with a trial of constant lengths and complete sensors"
        )
    return replace(log, trials=trials)


def _findings(name: str, log: RigLog) -> list[Finding]:
    """The truth, if it is known, and the results of both programs."""
    truth = [_true(name)] if name in TRUTH else []
    dry = name not in TRUTH or LEVEL in TRUTH[name]
    both = [_timed(diagnosed, name, log), _timed(sysid_fit.identified, name, log)]
    found = [*truth, *both]
    return [*found, sysid_fit.told(name, log)] if dry else found


def _timed(find: Callable[[str, RigLog], Finding], name: str, log: RigLog) -> Finding:
    began_s = used_cpu_s()
    return replace(find(name, log), cpu_s=used_cpu_s() - began_s)


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
    agreement = value(CONTROL, _OURS, SCALE) / value(CONTROL, UNTOLD, SCALE)

    def cpu(log: str, who: str) -> float:
        return by[log, who].cpu_s if (log, who) in by else math.nan

    return [
        report.Goal(
            name="mujoco.sysid's fits of a log over our whole diagnosis",
            measured=cpu(DRY, UNTOLD) / cpu(DRY, _OURS),
            accuracy="residuals below",
        ),
        report.Goal(name=f"{DRY}: our error of its level", measured=abs(level - 1), bound=LEVEL_BOUND),
        report.Goal(
            name=f"{DRY}: our residual / noise", measured=residual(DRY, _OURS), bound=FLOOR_BOUND
        ),
        report.Goal(
            name=f"{DRY}: residual / noise of mujoco.sysid",
            measured=residual(DRY, UNTOLD),
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
    reason = sysid_fit.missing()
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
