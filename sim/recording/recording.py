"""A recording: named signals over time, with units in their names, and the parameters of the run.

The first columns are those of a rig's trial, so that the same tools read simulated and measured
data.
"""

import json
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from models import units
from models.errors import InvalidValue, NeedleError
from sim.files import writing
from sim.kernel import memory_map
from sim.needles.run import Run
from sim.recording.html_table import html_table

Array = NDArray[np.float64]

FORMAT = "needle-recording/1"
_NUMBERED = re.compile(r"(shaft|tissue)_\d{3}_")
_UNITS = {
    "_s": "s",
    "_deg": "deg",
    "_mm": "mm",
    "_n_mm": "N mm",
    "_mm_s": "mm/s",
    "_mj": "mJ",
    "_mpa": "MPa",
    "_count": "-",
}


class UnreadableRecording(NeedleError):
    """A file is not a recording."""


@dataclass(frozen=True, kw_only=True)
class Recording:
    """Signals as columns, one row per sample.

    Attributes:
      table: `time_s` first; every name ends in its unit.
      parameters: everything that the run depended on, as plain JSON values.
    """

    table: pd.DataFrame
    parameters: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if "time_s" not in self.table.columns:
            raise InvalidValue("table", list(self.table.columns), "a column time_s")
        for name in self.table.columns:
            unit_of(str(name))

    def __getitem__(self, name: str) -> Array:
        """A signal by name, (N,)."""
        if name not in self.table.columns:
            raise InvalidValue("signal", name, f"one of {', '.join(self.names)}")
        return np.asarray(self.table[name], float)

    @property
    def names(self) -> list[str]:
        """Names of all signals except those that are numbered along the shaft."""
        return [str(c) for c in self.table.columns if not _NUMBERED.match(str(c))]

    def group(self, prefix: str) -> Array:
        """Numbered signals `prefix_000_...`, (N, count)."""
        names = [c for c in self.table.columns if re.match(rf"{prefix}_\d{{3}}_", str(c))]
        return np.asarray(self.table[names], float)

    def _repr_html_(self) -> str:
        """The run and the range of every signal, for a notebook."""
        time = self["time_s"]
        what = self.parameters.get("description") or self.parameters.get("protocol") or "a recording"
        ranges = {n: (self[n].min(), self[n].max(), self[n][-1]) for n in self.names[1:]}
        shown = pd.DataFrame.from_dict(ranges, orient="index", columns=["least", "greatest", "last"])
        return html_table(f"{what}: {time.size} samples, {time[0]:g} to {time[-1]:g} s", shown)

    def write(self, path: Path, *, force: bool = False) -> None:
        """Write as CSV or Parquet, according to the ending of the path.

        Raises:
          InvalidValue: another ending.
          OutputExists: the path exists and `force` is not given.
        """
        header = json.dumps({"format": FORMAT, "parameters": self.parameters})
        if path.suffix == ".csv":
            with writing(path, force=force) as part, part.open("w", encoding="utf-8") as file:
                file.write(f"# {header}\n")
                self.table.to_csv(file, index=False, float_format="%.9g")
        elif path.suffix == ".parquet":
            content = pa.Table.from_pandas(self.table, preserve_index=False)
            content = content.replace_schema_metadata({"needle": header})
            with writing(path, force=force) as part:
                pq.write_table(content, part)
        else:
            raise InvalidValue("path", str(path), "a path that ends in .csv or .parquet")


def unit_of(name: str) -> str:
    """The unit that a signal's name ends in.

    Raises:
      InvalidValue: the name ends in no known unit.
    """
    for ending in sorted(_UNITS, key=len, reverse=True):
        if name.endswith(ending):
            return _UNITS[ending]
    raise InvalidValue("signal", name, "a name that ends in one of " + ", ".join(_UNITS))


def read(path: Path) -> Recording:
    """Read a recording that `Recording.write` wrote.

    Raises:
      UnreadableRecording: the file cannot be read, or has another format.
    """
    try:
        if path.suffix == ".parquet":
            content = pq.read_table(path)
            header = json.loads((content.schema.metadata or {}).get(b"needle", b"{}"))
            table = content.to_pandas()
        else:
            with path.open(encoding="utf-8") as file:
                header = json.loads(file.readline().removeprefix("# "))
                table = pd.read_csv(file)
    except (OSError, ValueError, pa.ArrowException) as error:
        raise UnreadableRecording(f"{path}: {error}") from error
    if not isinstance(header, dict) or header.get("format") != FORMAT:
        raise UnreadableRecording(f"{path}: expected the header of a {FORMAT} file, found another")
    return Recording(table=table, parameters=header["parameters"])


def record(run: Run, parameters: dict[str, Any] | None = None) -> Recording:
    """The signals of a run; `parameters` are added to those of its set-up."""
    inputs, outputs = run.inputs, run.outputs
    columns: dict[str, Array] = {
        "time_s": inputs.time_s,
        "base_angle_deg": run.shaft_deg,
        "base_torque_n_mm": run.base_torque_n_mm,
        "tip_angle_deg": run.tip_deg,
        "inserted_mm": inputs.inserted_mm,
        "free_mm": inputs.free_mm,
        "speed_mm_s": inputs.speed_mm_s,
        "tip_torque_n_mm": inputs.tip_torque_n_mm,
        "needle_base_deg": run.base_deg,
        "friction_n_mm": outputs[:, memory_map.O_FRICTION] / units.N_MM,
        "drive_work_mj": outputs[:, memory_map.O_WORK] * 1e3,
        "dissipated_mj": outputs[:, memory_map.O_DISSIPATED] * 1e3,
        "tissue_energy_mj": outputs[:, memory_map.O_TISSUE_ENERGY] * 1e3,
        "unconverged_count": outputs[:, memory_map.O_FAILED],
        "torsion_energy_mj": outputs[:, memory_map.O_SHAFT_ENERGY] * 1e3,
        "shear_stress_mpa": run.setup.needle.shear_stress_mpa(1.0)
        * outputs[:, memory_map.O_SHAFT_TORQUE]
        / units.N_MM,
        "correction_n_mm": outputs[:, memory_map.O_CORRECTION] / units.N_MM,
        "newton_iterations_count": outputs[:, memory_map.O_ITERATIONS],
        "landing_error_deg": outputs[:, memory_map.O_LANDING] / units.DEG,
    }
    if run.angles_rad is not None:
        degrees = run.angles_rad / units.DEG
        columns |= {f"shaft_{i:03d}_deg": degrees[:, i] for i in range(degrees.shape[1])}
    if run.tissue_rad is not None and np.any(run.tissue_rad):
        twist = run.tissue_rad.sum(axis=1).reshape(len(run.tissue_rad), -1) / units.DEG
        columns |= {f"tissue_{i:03d}_deg": twist[:, i] for i in range(twist.shape[1])}
    return Recording(table=pd.DataFrame(columns), parameters=describe(run) | (parameters or {}))


def describe(run: Run) -> dict[str, Any]:
    """Everything that a run depended on, as plain JSON values."""
    setup = run.setup
    return {
        "needle": setup.needle.model_dump(mode="json"),
        "tissue": setup.tissue.model_dump(mode="json"),
        "drive": setup.drive.model_dump(mode="json"),
        "discretisation": setup.discretisation.model_dump(mode="json"),
        "mesh": setup.mesh.value,
        "nodes_mm": [round(float(x), 9) for x in setup.nodes_mm],
        "stretching": setup.stretching,
    }
