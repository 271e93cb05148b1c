"""A rig as the diagnosis sees it: the nominal one, and what an effect changes.

Every field is neutral by default: a `RigModel` as constructed is the nominal rig.
Units are those of the effects' vocabulary.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.rig_log import Rig
from models.drive import Drive
from models.needle import Needle
from models.tissue import Interface, Layer, Tissue
from sim.discretisation import Arrangement, Discretisation, Mesh
from sim.schedule import Schedule
from sim.spec import Setup

Array = NDArray[np.float64]

ROWS = 5  # of the law table: two layers, sheath, entry, tip


@dataclass(frozen=True, kw_only=True)
class RigModel:
    """What may differ from the nominal rig."""

    stiffness_scale: float = 1.0
    damping_scale: float = 1.0
    exponent: float = 1.0
    plateau: float = 1e-5
    kinetic: float = 0.0
    static_excess: float = 0.0
    stribeck: float = 1.0
    shared: float = 0.0
    tissue_stiffness: float = 0.0
    tissue_time: float = 0.0
    layer_ratio: float = 1.0
    layer_boundary: float = 0.5
    entry: float = 0.0
    sheath: float = 0.0
    load: float = 0.0
    backlash: float = 0.0
    base_stiffness: float = 0.0
    tip_drag: float = 0.0
    curvature: float = 0.0
    curvature_phase: float = 0.0
    tip_bias: float = 0.0
    tip_scale: float = 1.0
    tip_delay: float = 0.0
    torque_bias: float = 0.0
    slip_standing: float = 0.0
    slip_growing: float = 0.0

    def needle(self, rig: Rig, length_mm: float) -> Needle:
        """The needle, of the length that a trial needs."""
        nominal = dict(rig.needle)
        nominal["shear_modulus_gpa"] *= self.stiffness_scale
        return Needle(
            **nominal,
            length_mm=length_mm,
            tip_drag_n_mm_s_per_rad=self.tip_drag,
            curvature_n_mm_per_mm=self.curvature,
            curvature_phase_deg=self.curvature_phase,
            load_coefficient=self.load,
        )

    def tissue(self, rig: Rig) -> Tissue:
        """The tissue; two layers keep the total damping nominal."""
        damping = rig.tissue.damping_n_mm_s_per_mm * self.damping_scale
        if self.layer_ratio == 1.0:
            layers: tuple[Layer, ...] = (Layer(interface=self._interface(damping)),)
        else:
            boundary, ratio = self.layer_boundary, self.layer_ratio
            shallow = damping / (boundary + ratio * (1 - boundary))
            layers = (
                Layer(interface=self._interface(shallow), fraction=boundary),
                Layer(interface=self._interface(ratio * shallow)),
            )
        return Tissue(layers=layers, entry_friction_n_mm=self.entry)

    def _interface(self, damping: float) -> Interface:
        return Interface(
            viscous_n_mm_s_per_mm=damping,
            exponent=self.exponent,
            plateau_rad_s=self.plateau,
            kinetic_n_mm_per_mm=self.kinetic,
            static_n_mm_per_mm=self.kinetic + self.static_excess,
            stribeck_rad_s=self.stribeck,
            shared_n_mm_per_mm=self.shared,
            stiffness_n_mm_per_rad_per_mm=self.tissue_stiffness or None,
            time_constant_s=self.tissue_time,
        )

    def drive(self) -> Drive:
        """Chuck and sheath."""
        return Drive(
            stiffness_n_mm_per_rad=self.base_stiffness or None,
            backlash_deg=self.backlash,
            sheath_friction_n_mm_per_mm=self.sheath,
        )

    def without_sensors(self) -> "RigModel":
        """The rig whose sensors show what is."""
        return replace(self, tip_bias=0.0, tip_scale=1.0, tip_delay=0.0, torque_bias=0.0)

    def setup(self, rig: Rig, schedule: Schedule, *, elements: int, step_s: float) -> Setup:
        """The MuJoCo needle that goes through a schedule."""
        shaft = max(schedule.longest_mm, 1.0)
        standing = schedule.mesh is Mesh.EULERIAN
        inserted = schedule.inserted_mm[0] if standing else shaft - schedule.free_mm[0]
        return Setup(
            needle=self.needle(rig, shaft),
            tissue=self.tissue(rig),
            drive=self.drive(),
            discretisation=Discretisation(
                step_s=step_s,
                # A mesh that goes with the needle has the free length in it as well.
                elements=elements if standing else 2 * elements,
                arrangement=Arrangement.SIBLINGS,
            ),
            mesh=schedule.mesh,
            free_mm=float(schedule.free_mm[0]),
            inserted_mm=float(inserted),
            rows=ROWS,
            slip_share=self.slip_standing if standing else self.slip_growing,
        )

    def sensed(self, time_s: Array, tip_deg: Array, torque_n_mm: Array) -> tuple[Array, Array]:
        """What the sensors show of tip and base torque."""
        shown = tip_deg
        if self.tip_delay != 0.0:
            shown = np.interp(time_s - self.tip_delay, time_s, tip_deg)
        return self.tip_bias + self.tip_scale * shown, torque_n_mm + self.torque_bias
