"""A closed-loop run as a recording: true values, readings, estimate and command."""

from typing import Any

import numpy as np
import pandas as pd

from models.bevel import path_mm
from sim.closed_loop import ClosedLoopRun
from sim.recording.recording import Recording, record


def record_closed_loop(controlled: ClosedLoopRun, parameters: dict[str, Any] | None = None) -> Recording:
    """Signals of the run, the sensors and the controller; the tip's path if the needle is inserted."""
    base = record(controlled.run, parameters)
    columns = {"wanted_tip_deg": controlled.reference_deg}
    columns |= {f"measured_{name}": values for name, values in controlled.measured.items()}
    columns |= {
        name: values
        for name, values in controlled.log.items()
        if name != "estimate_damping_n_mm_s_per_mm"
    }
    inserted = controlled.run.inputs.inserted_mm
    if np.ptp(inserted) > 1.0:
        x, y, z = path_mm(inserted, np.radians(controlled.run.tip_deg)).T
        columns |= {"path_x_mm": x, "path_y_mm": y, "path_z_mm": z}
    return Recording(
        table=pd.concat([base.table, pd.DataFrame(columns)], axis=1), parameters=base.parameters
    )
