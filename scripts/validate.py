"""`needle validate`: run the cross-check, print it and write it."""

import math
from itertools import groupby
from pathlib import Path

from rich.console import Console
from rich.table import Table
from rich.text import Text

from scripts.exit_codes import ExitCode
from scripts.output_folder import output_folder
from scripts.progress_line import stage_line, within
from scripts.results import tell
from scripts.tables import print_table
from sim.files import Destination, ResultSet
from studies.crosscheck.findings import Findings
from studies.crosscheck.poles import SOURCES
from studies.crosscheck.report import cross_check, output_paths, write_report

DEFAULT = Path("out/validate")
_CHECKS_SHARE = 0.8  # of the time; the rest is for pictures and recordings
_AGREES = 0.02  # figures within 2 % of each other need no explanation


def run(out: Path | None, *, force: bool, console: Console) -> int:
    """Returns 1 if a bound fails."""
    findings, written = checked(output_folder(out, DEFAULT, output_paths, force=force))
    show(findings, console)
    code = tell(written, console)
    return code if findings.passed else ExitCode.BOUND_FAILS


def checked(destination: Destination) -> tuple[Findings, ResultSet]:
    """Run every check and write the report, with progress on the screen."""
    with stage_line() as stage:
        findings = cross_check(within(stage, 0.0, _CHECKS_SHARE))
        stage("drawing and recording", _CHECKS_SHARE)
        return findings, write_report(findings, destination)


def show(findings: Findings, console: Console) -> None:
    """Print poles, bounds and published figures."""
    print_table(console, poles_table(findings), keys=3)
    print_table(console, checks_table(findings))
    published = Table(
        "figure", "published", "ours", "ratio", "unit", "source", title="Published figures"
    )
    for c in findings.comparisons:
        numbers = (f"{c.published:.4g}", _number(c.ours, ".4g"), _number(c.ratio, ".3f"))
        published.add_row(c.item, *numbers, c.unit, c.source)
    print_table(console, published)
    console.print("Reasons for differences, where they are known:")
    differing = [c for c in findings.comparisons if not abs(c.ratio - 1) <= _AGREES]
    for note, items in groupby(differing, key=lambda c: c.note):
        if note:
            names = [c.item for c in items]
            more = f" and {len(names) - 1} more" if len(names) > 1 else ""
            console.print(f"  {names[0]}{more}: {note}", highlight=False)
    passed = ("every bound holds", "green") if findings.passed else ("a bound fails", "red")
    console.print(Text(*passed))


def _number(value: float, shape: str) -> str:
    return "never" if math.isnan(value) else format(value, shape)


def poles_table(findings: Findings) -> Table:
    """Measured poles and their error against the closed form: a section per source, a row per case."""
    table = Table(
        *("length\nmm", "free\nmm", "drive", "poles identified from MuJoCo, rad/s"),
        "worst\nerror %",
        title="Slowest four poles",
    )
    for source, of_source in groupby(findings.poles, key=lambda p: p.source):
        table.add_section()
        bound = 100 * SOURCES[source].bound
        table.add_row("", "", "", Text(source.words, "bold"), f"<= {bound:.2g}")
        cases = groupby(of_source, key=lambda p: (p.length_mm, p.free_mm, p.drive))
        for (length, free, drive), group in cases:
            poles = list(group)
            shown = " ".join(f"{p.measured:9.3f}" for p in poles)
            worst = max(p.error for p in poles)
            table.add_row(f"{length:g}", f"{free:g}", drive, shown, f"{100 * worst:.3f}")
    return table


def checks_table(findings: Findings) -> Table:
    """A table of all bounds."""
    table = Table("bound", "measured", "must be", "unit", "", title="Bounds")
    for c in findings.checks:
        result = Text("holds", "green") if c.passed else Text("fails", "red")
        table.add_row(c.name, f"{c.value:.4g}", c.bounds, c.unit, result)
    return table
