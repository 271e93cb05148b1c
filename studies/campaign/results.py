"""Results of a campaign on disk: a Parquet data set, written piece by piece.

A folder has `campaign.yaml`, the resolved campaign, and `results/`, one file per piece. A piece is
complete or absent, so that an interrupted campaign continues with the missing ones.
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import yaml

from models.errors import InvalidValue, OutputExists
from sim.files import write_text, writing
from studies.campaign.campaign import Campaign
from studies.campaign.cases import pieces
from studies.campaign.columns import Row, schema


@dataclass(frozen=True, kw_only=True)
class ResultFolder:
    """The folder of one campaign."""

    folder: Path
    campaign: Campaign

    @property
    def dataset(self) -> Path:
        """Folder of the Parquet data set."""
        return self.folder / "results"

    @property
    def outputs(self) -> list[Path]:
        """All files that a campaign writes."""
        names = ("summary.csv", "summary.png", "bands.csv", "bands.png")
        return [self._described, self.dataset, *(self.folder / name for name in names)]

    @property
    def begun_at_s(self) -> float | None:
        """Unix time at which this campaign was last started or continued here, s; None: never."""
        return self._described.stat().st_mtime if self._is_this_campaign() else None

    @property
    def _described(self) -> Path:
        return self.folder / "campaign.yaml"

    def begin(self, *, resume: bool = False, force: bool = False) -> None:
        """Prepare the folder for this campaign.

        Args:
          resume: continue with existing results; force: remove them.

        Raises:
          OutputExists: there are results, and neither `resume` nor `force` is given.
          InvalidValue: the results are of another campaign, or of more samples.
        """
        described = self._described
        if described.exists() and resume:
            self._refuse_another(described)
        elif (described.exists() or self.dataset.exists()) and not force:
            raise OutputExists(
                f"{self.folder} has results of a campaign; continue it with --resume, replace it with"
                " --force, or give another folder with --out"
            )
        elif force:
            for path in self._files:
                path.unlink()
        write_text(described, self.campaign.as_yaml(), force=True)

    def _refuse_another(self, described: Path) -> None:
        if not self._is_this_campaign():
            raise InvalidValue(
                str(described),
                "results of another campaign",
                f"results of {self.campaign.name!r} with the same fields and the same MuJoCo",
                "give another folder with --out, or replace these results with --force",
            )
        samples = yaml.safe_load(described.read_text(encoding="utf-8"))["samples"]
        if samples > self.campaign.samples:
            raise InvalidValue(
                "samples",
                self.campaign.samples,
                f"at least {samples}, as in {described}: they may only grow",
            )

    def _is_this_campaign(self) -> bool:
        if not self._described.is_file():
            return False
        first = self._described.read_text(encoding="utf-8", errors="replace").partition("\n")[0]
        return first.split(" ")[-1] == self.campaign.fingerprint

    @property
    def _files(self) -> list[Path]:
        return sorted(self.dataset.glob("piece-*.parquet"))

    def missing(self) -> list[range]:
        """Pieces that are missing or damaged."""
        return [piece for piece in pieces(self.campaign) if not self._is_there(piece)]

    def _path(self, piece: range) -> Path:
        return self.dataset / f"piece-{piece.start:09d}.parquet"

    def _is_there(self, piece: range) -> bool:
        try:
            table = pq.read_table(self._path(piece), page_checksum_verification=True)
        except (OSError, pa.ArrowException):
            return False
        whole = table.schema.equals(schema(self.campaign), check_metadata=True)
        return bool(whole and table["case"].to_pylist() == list(piece))

    def write(self, piece: range, rows: Sequence[Row]) -> None:
        """Write a piece: it gets its name once it is on the disk."""
        table = pa.Table.from_pylist(list(rows), schema=schema(self.campaign))
        with writing(self._path(piece), force=True) as part, part.open("wb") as file:
            pq.write_table(table, file, write_page_checksum=True)
            file.flush()
            os.fsync(file.fileno())

    def read(self) -> pd.DataFrame:
        """Rows of all pieces, by case."""
        tables = [pq.read_table(path, partitioning=None) for path in self._files]
        rows: pd.DataFrame = pa.concat_tables(tables).to_pandas()
        return rows.sort_values("case", ignore_index=True)
