"""`report.html`: the diagnosis for people, in one file that opens without a network.

The answer comes first, then why to believe it, and last what only few will look up.
"""

import re
from collections.abc import Callable, Mapping
from typing import Any

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import Page, Part, page_of, section
from diagnosis.report.sections.agreement import agreement_parts
from diagnosis.report.sections.alternatives import alternatives_section
from diagnosis.report.sections.front import TITLE, front
from diagnosis.report.sections.limits import limits_section
from diagnosis.report.sections.missing import missing_section
from diagnosis.report.sections.parameters import parameters_section
from diagnosis.report.sections.rig import rig_section
from diagnosis.report.sections.search import search_section
from diagnosis.report.sections.sensors import sensors_section
from diagnosis.report.sections.where import where_section
from diagnosis.result import Diagnosis
from diagnosis.workers import Workers


def page(found: Diagnosis, report: Mapping[str, Any]) -> Page:
    """The whole page; `report` is report.json."""
    return page_begun(found, report, Workers())()


def page_begun(found: Diagnosis, report: Mapping[str, Any], workers: Workers) -> Callable[[], Page]:
    """The same, whose sections are made in other processes meanwhile, if there are any."""
    parts: list[Part] = [
        (missing_section, found),
        *agreement_parts(found),
        (where_section, found),
        (parameters_section, found, report),
        (alternatives_section, found),
        (limits_section, found),
        (search_section, found),
        (sensors_section, found),
        (rig_section, found),
    ]
    calls = [workers.begin(section, make, *shown) for make, *shown in parts]
    return lambda: _page(found, [part for call in calls for part in call()])


def _page(found: Diagnosis, body: list[str]) -> Page:
    name = f"{found.log.name}: gap report" if found.log.name else TITLE
    return page_of(name, [*front(found), html.contents(_titles(body)), *body])


def _titles(parts: list[str]) -> list[str]:
    """Headings of the second level, plain."""
    found = [re.fullmatch(r"<h2[^>]*>([^<]*)</h2>", part) for part in parts]
    return [match[1] for match in found if match]
