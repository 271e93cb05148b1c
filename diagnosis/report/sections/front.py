"""The head of `report.html`: whose log, when and by what, then the answer in three parts."""

from importlib.metadata import PackageNotFoundError, version

from diagnosis.report import html_parts as html
from diagnosis.report.answer import answer
from diagnosis.report.fallible import section
from diagnosis.result import Diagnosis

TITLE = "Gap report"
_PACKAGE = "needle-torsion"


def front(found: Diagnosis) -> list[str]:
    """Origin, constants of the rig, answer, warnings; each may fail alone."""
    return [
        *section(_about, found),
        *section(_answer, found, title=TITLE),
        *section(_warnings, found),
    ]


def _about(found: Diagnosis) -> list[str]:
    return [html.paragraph(told(found), "origin") for told in (_origin, _constants)]


def _answer(found: Diagnosis) -> list[str]:
    what, sure, then = answer(found)
    return [html.heading(what, level=1), html.paragraph(sure, "lead"), html.paragraph(then, "lead")]


def _warnings(found: Diagnosis) -> list[str]:
    return html.warnings(found.warnings)


def tool_version() -> str:
    """The installed version of the tool."""
    try:
        return version(_PACKAGE)
    except PackageNotFoundError:
        return "of unknown version"


def _origin(found: Diagnosis) -> str:
    named = f"log {found.log.name}" if found.log.name else "log"
    day = f", diagnosed on {found.diagnosed_on.isoformat()}" if found.diagnosed_on else ""
    return f"{TITLE}: {named}{day}, {_PACKAGE} {tool_version()}"


def _constants(found: Diagnosis) -> str:
    rig, trials = found.log.rig, len(found.log.trials)
    needle = rig.needle
    return (
        f"Nominal rig: needle of {needle.diameter_mm:g} mm, shear modulus "
        f"{needle.shear_modulus_gpa:g} GPa, "
        f"damping {rig.tissue.damping_n_mm_s_per_mm:g} N mm s / rad / mm; "
        f"{trials} trial{'s' if trials > 1 else ''}"
    )
