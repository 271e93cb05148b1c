"""The files that the study writes."""

import json
from pathlib import Path

from sim.files import refuse_existing, write_text
from studies.published.report.contents import as_json
from studies.published.report.page import page
from studies.published.study import PublishedStudy


def output_paths(folder: Path) -> list[Path]:
    """What `write_report` will write."""
    return [folder / "paper.html", folder / "paper.json"]


def write_report(study: PublishedStudy, folder: Path, *, force: bool = False) -> list[Path]:
    """Write page and JSON, the JSON last; returns the paths.

    Raises:
      OutputExists: one of them exists and `force` is not given.
    """
    paths = output_paths(folder)
    refuse_existing(paths, force=force)
    write_text(paths[0], page(study), force=force)
    write_text(paths[1], json.dumps(as_json(study), indent=1, allow_nan=False), force=force)
    return paths
