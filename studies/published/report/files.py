"""The files that the study writes."""

import json
from pathlib import Path

from diagnosis.report.fallible import write_page
from sim.files import Destination, ResultSet, publishing, write_text
from studies.published.report.contents import as_json
from studies.published.report.page import page
from studies.published.study import PublishedStudy


def output_paths(folder: Path) -> list[Path]:
    """All files that `write_report` writes."""
    return [folder / "paper.html", folder / "paper.json"]


def write_report(study: PublishedStudy, destination: Destination) -> ResultSet:
    """Write JSON and page as one set; a page that fails is left out, and so are its pictures that fail.

    Raises:
      OutputExists, UnsafeOutput, UnwritableOutput: nothing is written.
    """
    paths = output_paths(destination.folder)
    with publishing(destination, paths) as results:
        shown, told = paths
        write_text(results.at(told), json.dumps(as_json(study), indent=1, allow_nan=False))
        write_page(lambda: page(study), results, shown)
    return results
