"""The law table: the input of the compiled tissue, made of the records that users write."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from models import units
from models.contact import ContactCurve, ContactVariable
from models.drive import Drive
from models.kerf import Kerf
from models.needle import Needle
from models.tissue import Interface, Layer, Section, Tissue
from sim.kernel import memory_map

Array = NDArray[np.float64]

_PER_MM = units.N_MM / units.MM
_TORQUES_PER_LENGTH = [
    memory_map.L_VISCOUS,
    memory_map.L_KINETIC,
    memory_map.L_STATIC,
    memory_map.L_SHARED,
    memory_map.L_STIFFNESS,
    memory_map.L_CURVATURE,
    memory_map.L_WAVE,
    memory_map.L_KEYED,
]
_REMEMBERED = {
    ContactVariable.SLIP: (memory_map.SLIP_SO_FAR, units.DEG),
    ContactVariable.AGE: (memory_map.AGE, 1.0),
    ContactVariable.HEAT: (memory_map.HEAT, 1.0),
    ContactVariable.BROKEN: (memory_map.BROKEN, 1.0),
    ContactVariable.TURNED: (memory_map.TURNED, units.DEG),
    ContactVariable.ALIGNED: (memory_map.ALIGNED, 1.0),
    ContactVariable.TWIST: (memory_map.TWIST, units.DEG),
    ContactVariable.STRAINED: (memory_map.STRAINED, units.DEG),
}


@lru_cache(maxsize=128)  # trial after trial of a fit asks for the same
def law_table(needle: Needle, drive: Drive, tissue: Tissue, *, rows: int = 0) -> Array:
    """Rows of `sim.kernel.memory_map`, SI: tissue layers, other laws of the tissue, sheath, entry, tip;
    read-only.

    Args:
      rows: pad with rows that do nothing up to this number, so that models of
        different rigs have the same number of rows.
    """
    table = _layers(tissue.layers, needle)
    table += [_over_inserted_length(law) for law in tissue.throughout]
    table += [_section(section) for section in tissue.sections]
    table += [_at_tip(law) for law in tissue.at_tip]
    table += [_kerf(kerf, needle) for kerf in tissue.kerfs]
    table += [_at_entry(law) for law in tissue.at_entry]
    table += [_over_free_length(law) for law in drive.in_sheath]
    if drive.sheath_friction_n_mm_per_mm > 0:
        table.append(_sheath(drive.sheath_friction_n_mm_per_mm * _PER_MM))
    if tissue.entry_friction_n_mm > 0:
        table.append(_point_dry(tissue.entry_friction_n_mm * units.N_MM))
    if needle.tip_drag_n_mm_s_per_rad > 0 or needle.load_coefficient > 0:
        table.append(_tip(needle))
    while len(table) < rows:
        table.append(_inactive_row())
    whole = np.array(table)
    whole.setflags(write=False)
    return whole


def _inactive_row() -> Array:
    row = np.zeros(memory_map.COLUMNS)
    row[[memory_map.L_EXPONENT, memory_map.L_CYCLES]] = 1.0
    return row


def _layers(layers: tuple[Layer, ...], needle: Needle) -> list[Array]:
    """Each layer starts where the previous one ends; the last takes the rest."""
    rows, depth, share = [], 0.0, 0.0
    for layer in layers:
        row = _interface(layer.interface)
        if needle.curvature_n_mm_per_mm > 0:
            row[memory_map.L_CURVATURE] = needle.curvature_n_mm_per_mm * _PER_MM
            row[memory_map.L_PHASE] = needle.curvature_phase_deg * units.DEG
        row[[memory_map.L_TOP_CONST, memory_map.L_TOP_FREE, memory_map.L_TOP_INSERTED]] = (
            depth,
            1.0,
            share,
        )
        if layer.thickness_mm is not None:
            depth += layer.thickness_mm * units.MM
        elif layer.fraction is not None:
            share += layer.fraction
        else:
            depth, share = 0.0, 1.0  # the whole inserted length
        row[[memory_map.L_END_CONST, memory_map.L_END_FREE, memory_map.L_END_INSERTED]] = (
            depth,
            1.0,
            share,
        )
        rows.append(row)
    return rows


def _over_inserted_length(law: Interface) -> Array:
    row = _interface(law)
    row[[memory_map.L_TOP_FREE, memory_map.L_END_FREE, memory_map.L_END_INSERTED]] = 1.0
    return row


def _section(section: Section) -> Array:
    """From the tip backwards; not beyond the place where the shaft enters."""
    row = _over_inserted_length(section.interface)
    row[memory_map.L_TOP_INSERTED] = 1.0
    row[memory_map.L_TOP_CONST] = -(section.from_tip_mm + section.length_mm) * units.MM
    row[memory_map.L_END_CONST] = -section.from_tip_mm * units.MM
    return row


def _over_free_length(law: Interface) -> Array:
    row = _interface(law)
    row[memory_map.L_END_FREE] = 1.0
    return row


def _at_tip(law: Interface) -> Array:
    """A law at the tip alone, where torques are not per mm."""
    row = _at_entry(law)
    row[memory_map.L_TOP_INSERTED] = 1.0
    return row


def _kerf(kerf: Kerf, needle: Needle) -> Array:
    """At the tip."""
    row = _inactive_row()
    row[[memory_map.L_POINT, memory_map.L_TOP_FREE, memory_map.L_TOP_INSERTED]] = 1.0
    angle = (kerf.angle_deg or 0.0) * units.DEG
    row[memory_map.L_STIFFNESS] = kerf.torque_n_mm * units.N_MM / (angle or 1.0)
    row[memory_map.L_KERF_ANGLE] = angle
    row[memory_map.L_KERF] = needle.radius_mm / kerf.travel_mm
    row[memory_map.L_BACKWARDS] = kerf.backwards
    return row


def _at_entry(law: Interface) -> Array:
    """A law where the shaft enters alone, where torques are not per mm."""
    row = _interface(law)
    row[_TORQUES_PER_LENGTH] *= units.MM
    row[[memory_map.L_POINT, memory_map.L_TOP_FREE]] = 1.0
    return row


def _interface(law: Interface) -> Array:
    row = _inactive_row()
    row[memory_map.L_VISCOUS] = law.viscous_n_mm_s_per_mm * _PER_MM
    row[memory_map.L_EXPONENT], row[memory_map.L_PLATEAU] = law.exponent, law.plateau_rad_s
    row[memory_map.L_KINETIC] = law.kinetic_n_mm_per_mm * _PER_MM
    row[memory_map.L_STATIC] = law.static_level_n_mm_per_mm * _PER_MM
    row[memory_map.L_STRIBECK] = law.stribeck_rad_s or 1.0
    row[memory_map.L_SHARED] = law.shared_n_mm_per_mm * _PER_MM
    row[memory_map.L_AXIAL] = law.shared_axial_ratio
    row[memory_map.L_STIFFNESS] = (law.stiffness_n_mm_per_rad_per_mm or 0.0) * _PER_MM
    row[memory_map.L_TIME] = law.time_constant_s
    row[memory_map.L_FOLLOWS] = law.viscosity_exponent
    row[memory_map.L_FLOWS] = (law.flows_at_deg or 0.0) * units.DEG
    row[memory_map.L_DRAGGED] = law.dragged_ratio
    row[memory_map.L_CURVATURE] = law.orientation_n_mm_per_mm * _PER_MM
    row[memory_map.L_WAVE] = law.orientation_viscous_n_mm_s_per_mm * _PER_MM
    row[memory_map.L_KEYED] = law.orientation_dry_n_mm_per_mm * _PER_MM
    row[memory_map.L_PHASE] = law.orientation_phase_deg * units.DEG
    row[memory_map.L_CYCLES] = law.orientation_cycles
    row[memory_map.L_ASYMMETRY] = law.asymmetry
    if law.varies:
        row[memory_map.L_VARIES] = memory_map.TORQUE_VARIES
    elif law.stiffness_varies:
        row[memory_map.L_VARIES] = memory_map.STIFFNESS_VARIES
    if law.rate_curve:
        low, high = np.log(law.rate_range_rad_s)
        row[memory_map.L_RATE_LOW] = low
        row[memory_map.L_RATE_STEP] = (high - low) / (len(law.rate_curve) - 1)
        level_beyond = memory_map.CURVE_POINTS - len(law.rate_curve)
        factors = np.pad(law.rate_curve, (0, level_beyond), mode="edge")
        row[memory_map.L_CURVE_0 : memory_map.L_CONTACT] = np.log(factors)
    if law.contact:
        _set_contact(row, law.contact)
    shaped = law.asymmetry != 0.0 or law.varies or law.rate_curve or law.contact
    row[memory_map.L_SHAPED] = bool(shaped)
    return row


def _set_contact(row: Array, curve: ContactCurve) -> None:
    remembered, unit = _REMEMBERED[curve.over]
    row[memory_map.L_CONTACT] = remembered
    row[memory_map.L_CONTACT_SCALE] = curve.scale * unit
    row[memory_map.L_CONTACT_STEP] = np.log1p(curve.last / curve.scale) / (memory_map.CONTACT_POINTS - 1)
    row[memory_map.L_RENEWAL] = curve.renewal_deg * units.DEG
    row[memory_map.L_FADING] = curve.fading_s
    row[memory_map.L_FIRST] = curve.first_broken
    row[memory_map.L_CONTACT_0 :] = np.log(curve.factors)


def _sheath(level: float) -> Array:
    row = _inactive_row()
    row[memory_map.L_END_FREE] = 1.0
    row[[memory_map.L_KINETIC, memory_map.L_STATIC]] = level
    return row


def _point_dry(level: float) -> Array:
    row = _inactive_row()
    row[[memory_map.L_POINT, memory_map.L_TOP_FREE]] = 1.0
    row[[memory_map.L_KINETIC, memory_map.L_STATIC]] = level
    return row


def _tip(needle: Needle) -> Array:
    row = _inactive_row()
    row[[memory_map.L_POINT, memory_map.L_TOP_FREE, memory_map.L_TOP_INSERTED]] = 1.0
    row[memory_map.L_VISCOUS] = needle.tip_drag_n_mm_s_per_rad * units.N_MM
    row[memory_map.L_LOAD] = needle.load_coefficient
    return row
