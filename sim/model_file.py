"""A needle's model from an MJCF file that `needle insert --mjcf` wrote and the user may have changed.

Stiffness, inertia, servos and time step are simulated as the file has them. Elements, tissue and
lengths have to be those of the protocol that runs on it.
"""

from pathlib import Path

import mujoco
import numpy as np

from models import units
from models.errors import InvalidValue
from sim.kernel import memory_map
from sim.law_table import law_table
from sim.needles.kept import compile_model
from sim.needles.setup import Setup

_SAME = 1e-4  # a file holds six digits


def read_model(path: Path, setup: Setup) -> mujoco.MjModel:
    """The model of a file, for a set-up.

    Raises:
      InvalidValue: the file is no MuJoCo model, was not written by this project, or has another set-up.
    """
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, OSError) as error:
        raise InvalidValue(str(path), str(error).splitlines()[0], "a MuJoCo model (MJCF)") from error
    head = _header(model, path)
    found, expected = int(head[memory_map.H_ELEMENTS]), setup.nodes_mm.size - 1
    if found != expected:
        raise InvalidValue(
            str(path),
            f"{found} elements",
            f"the {expected} elements of the protocol",
            "write the model of this protocol with `needle insert --mjcf`",
        )
    _check_lengths(model, path, setup)
    _check_tissue(model, path, setup)
    compile_model(setup)  # installs the callback
    return model


def _header(model: mujoco.MjModel, path: Path) -> np.ndarray:
    names = [model.numeric(i).name for i in range(model.nnumeric)]
    head = model.numeric("needle").data if "needle" in names else np.zeros(1)
    if head[memory_map.H_MAGIC] != memory_map.MAGIC:
        raise InvalidValue(
            str(path), "another model", "a needle as `needle insert --mjcf` of this version writes it"
        )
    return head


def _check_lengths(model: mujoco.MjModel, path: Path, setup: Setup) -> None:
    """Check the lengths: with others, the nodes would lie elsewhere in the tissue."""
    found, expected = model.numeric("needle_mesh").data / units.MM, setup.nodes_mm
    if not np.allclose(found, expected, rtol=_SAME, atol=_SAME):
        raise InvalidValue(
            str(path),
            f"a shaft with nodes from {found[0]:g} to {found[-1]:g} mm",
            f"the nodes of the protocol, {expected[0]:g} to {expected[-1]:g} mm from the chuck",
            "write the model of this protocol with `needle insert --mjcf`",
        )


def _check_tissue(model: mujoco.MjModel, path: Path, setup: Setup) -> None:
    law = law_table(setup.needle, setup.drive, setup.tissue, rows=setup.rows).ravel()
    found = model.numeric("needle_law").data
    if found.shape != law.shape or not np.allclose(found, law, rtol=_SAME, atol=0.0):
        raise InvalidValue(
            str(path),
            "another tissue",
            f"the tissue of the protocol, {setup.tissue.name}",
            "change the tissue in the protocol, and write the model again",
        )
