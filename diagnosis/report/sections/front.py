"""The head of `report.html`: whose log, when and by what, then the answer in three sentences."""

from importlib.metadata import PackageNotFoundError, version

from diagnosis.report import html_parts as html
from diagnosis.report.answer import answer
from diagnosis.result import Diagnosis

_PACKAGE = "needle-torsion"


def front(found: Diagnosis) -> list[str]:
    """Origin, constants of the rig, answer, warnings."""
    what, sure, then = answer(found)
    return [
        html.paragraph(_origin(found), "origin"),
        html.paragraph(_constants(found), "origin"),
        html.heading(what, level=1),
        html.paragraph(sure, "lead"),
        html.paragraph(then, "lead"),
        *html.warnings(found.warnings),
    ]


def tool_version() -> str:
    """The installed version of the tool."""
    try:
        return version(_PACKAGE)
    except PackageNotFoundError:
        return "of unknown version"


def _origin(found: Diagnosis) -> str:
    named = f"log {found.log.name}" if found.log.name else "log"
    day = f", diagnosed on {found.diagnosed_on.isoformat()}" if found.diagnosed_on else ""
    return f"Gap report: {named}{day}, {_PACKAGE} {tool_version()}"


def _constants(found: Diagnosis) -> str:
    rig, trials = found.log.rig, len(found.log.trials)
    needle = rig.needle
    return (
        f"Nominal rig: needle of {needle.diameter_mm:g} mm, shear modulus "
        f"{needle.shear_modulus_gpa:g} GPa, damping {rig.tissue.damping_n_mm_s_per_mm:g} N mm s / mm; "
        f"{trials} trial{'s' if trials > 1 else ''}"
    )
