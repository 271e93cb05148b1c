"""`report.html`: the diagnosis for people, in one file that opens without a network.

The answer comes first, then why to believe it, and last what only few will look up.
"""

import re
from collections.abc import Mapping
from typing import Any

from diagnosis.report import html_parts as html
from diagnosis.report.fallible import Page, page_of, section
from diagnosis.report.sections.agreement import agreement_section
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


def page(found: Diagnosis, report: Mapping[str, Any]) -> Page:
    """The whole page; `report` is report.json."""
    body = [
        *section(missing_section, found),
        *section(agreement_section, found),
        *section(where_section, found),
        *section(parameters_section, found, report),
        *section(alternatives_section, found),
        *section(limits_section, found),
        *section(search_section, found),
        *section(sensors_section, found),
        *section(rig_section, found),
    ]
    name = f"{found.log.name}: gap report" if found.log.name else TITLE
    return page_of(name, [*front(found), html.contents(_titles(body)), *body])


def _titles(parts: list[str]) -> list[str]:
    """Headings of the second level, plain."""
    found = [re.fullmatch(r"<h2[^>]*>([^<]*)</h2>", part) for part in parts]
    return [match[1] for match in found if match]
