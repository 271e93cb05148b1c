"""The law table: what the compiled tissue reads, from the records that people write."""

import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import Drive
from models.needle import Needle
from models.tissue import Interface, Layer, Tissue
from sim.kernel import wire

Array = NDArray[np.float64]

_PER_MM = units.N_MM / units.MM


def law_table(needle: Needle, drive: Drive, tissue: Tissue, *, rows: int = 0) -> Array:
    """Rows of `sim.kernel.wire`, SI: tissue layers, then sheath, entry and tip.

    Args:
      rows: pad with rows that do nothing up to this number, so that models of
        different rigs share a layout.
    """
    table = _layers(tissue.layers, needle)
    if drive.sheath_friction_n_mm_per_mm > 0:
        table.append(_sheath(drive.sheath_friction_n_mm_per_mm * _PER_MM))
    if tissue.entry_friction_n_mm > 0:
        table.append(_point_dry(tissue.entry_friction_n_mm * units.N_MM))
    if needle.tip_drag_n_mm_s_per_rad > 0 or needle.load_coefficient > 0:
        table.append(_tip(needle))
    while len(table) < rows:
        table.append(_nothing())
    return np.array(table)


def _nothing() -> Array:
    row = np.zeros(wire.COLUMNS)
    row[wire.L_EXPONENT] = 1.0
    return row


def _layers(layers: tuple[Layer, ...], needle: Needle) -> list[Array]:
    """Each layer starts where the previous one ends; the last takes the rest."""
    rows, depth, share = [], 0.0, 0.0
    for layer in layers:
        row = _interface(layer.interface)
        row[wire.L_CURVATURE] = needle.curvature_n_mm_per_mm * _PER_MM
        row[wire.L_PHASE] = needle.curvature_phase_deg * units.DEG
        row[[wire.L_TOP_CONST, wire.L_TOP_FREE, wire.L_TOP_INSERTED]] = depth, 1.0, share
        if layer.thickness_mm is not None:
            depth += layer.thickness_mm * units.MM
        elif layer.fraction is not None:
            share += layer.fraction
        else:
            depth, share = 0.0, 1.0  # the whole inserted length
        row[[wire.L_END_CONST, wire.L_END_FREE, wire.L_END_INSERTED]] = depth, 1.0, share
        rows.append(row)
    return rows


def _interface(law: Interface) -> Array:
    row = _nothing()
    row[wire.L_VISCOUS] = law.viscous_n_mm_s_per_mm * _PER_MM
    row[wire.L_EXPONENT], row[wire.L_PLATEAU] = law.exponent, law.plateau_rad_s
    row[wire.L_KINETIC] = law.kinetic_n_mm_per_mm * _PER_MM
    row[wire.L_STATIC] = law.static_level_n_mm_per_mm * _PER_MM
    row[wire.L_STRIBECK] = law.stribeck_rad_s or 1.0
    row[wire.L_SHARED] = law.shared_n_mm_per_mm * _PER_MM
    row[wire.L_STIFFNESS] = (law.stiffness_n_mm_per_rad_per_mm or 0.0) * _PER_MM
    row[wire.L_TIME] = law.time_constant_s
    return row


def _sheath(level: float) -> Array:
    row = _nothing()
    row[wire.L_END_FREE] = 1.0
    row[[wire.L_KINETIC, wire.L_STATIC]] = level
    return row


def _point_dry(level: float) -> Array:
    row = _nothing()
    row[[wire.L_POINT, wire.L_TOP_FREE]] = 1.0
    row[[wire.L_KINETIC, wire.L_STATIC]] = level
    return row


def _tip(needle: Needle) -> Array:
    row = _nothing()
    row[[wire.L_POINT, wire.L_TOP_FREE, wire.L_TOP_INSERTED]] = 1.0
    row[wire.L_VISCOUS] = needle.tip_drag_n_mm_s_per_rad * units.N_MM
    row[wire.L_LOAD] = needle.load_coefficient
    return row
