"""The parameters of a rig that effects change, and the MuJoCo needle that they make of a nominal rig.

Every field is neutral by default: `RigParameters()` is the nominal rig. Units are in the names;
scales, shares, ratios, exponents and coefficients have none. The order from motor to needle is: drive
shaft with encoder, torque sensor, bearing, chuck.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import BASE
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump, SmoothedReading
from models.drive import Drive
from models.needle import Needle
from models.tissue import Interface, Layer, Tissue
from sim.discretisation import PRESLIDING_DEG, Arrangement, Discretisation, Mesh
from sim.needles.setup import Setup
from sim.schedule import Schedule

LAW_ROWS = 5  # of the law table: two layers, sheath, entry, tip


@dataclass(frozen=True, kw_only=True)
class Past:
    """The turns of the base before a trial that began late.

    Attributes:
      trial: name of the trial.
      wound_deg: turn before a rest.
      turned_deg: turn up to the first sample, in addition to the twist that its readings show.
    """

    trial: str
    wound_deg: float = 0.0
    turned_deg: float = 0.0


@dataclass(frozen=True, kw_only=True)
class RigParameters:
    """Parameters that may differ from the nominal rig.

    Attributes:
      static_excess_n_mm_per_mm: static minus kinetic level of dry friction.
      shared_n_mm_per_mm: dry friction that is shared between turning and axial motion.
      tissue_stiffness_n_mm_per_rad_per_mm: stiffness of Kelvin-Voigt tissue; 0: rigid.
      tissue_time_constant_s: its damper / spring.
      tissue_dragged_ratio: share of the axial motion by which it goes along with the shaft.
      layer_ratio: damping of the deep layer / that of the shallow one.
      layer_boundary_fraction: depth of the boundary / inserted length.
      base_stiffness_n_mm_per_rad: stiffness of a spring between drive shaft and needle; 0: rigid.
      drive_friction_n_mm: dry friction of the bearing, which the torque sensor reads.
      presliding_deg: angle by which dry friction gives before it slides.
      base_scale: reading of the encoder / true angle of the drive shaft.
      inserted_offset_mm: true inserted length minus the logged one.
      offset_free_share: share of this by which the true free length is shorter than the logged one.
      material_share_constant_depth: share of the material derivative in the rate that tissue resists
        where the depth is constant; the rest is the spatial derivative of equation (9).
      material_share_growing_depth: the same where the depth changes.
      pasts: turns of the base before trials that began late.
      clock_starts: clocks of sensors that ran before trials.
      jumps: readings that are off from a moment on.
      smoothed: readings that were smoothed after recording.
      free: a free-form law; None: none.
    """

    stiffness_scale: float = 1.0
    damping_scale: float = 1.0
    rate_exponent: float = 1.0
    plateau_rad_s: float = 1e-5
    kinetic_n_mm_per_mm: float = 0.0
    static_excess_n_mm_per_mm: float = 0.0
    stribeck_rad_s: float = 1.0
    shared_n_mm_per_mm: float = 0.0
    tissue_stiffness_n_mm_per_rad_per_mm: float = 0.0
    tissue_time_constant_s: float = 0.0
    tissue_dragged_ratio: float = 0.0
    layer_ratio: float = 1.0
    layer_boundary_fraction: float = 0.5
    entry_friction_n_mm: float = 0.0
    sheath_friction_n_mm_per_mm: float = 0.0
    load_coefficient: float = 0.0
    backlash_deg: float = 0.0
    base_stiffness_n_mm_per_rad: float = 0.0
    tip_drag_n_mm_s_per_rad: float = 0.0
    curvature_n_mm_per_mm: float = 0.0
    curvature_phase_deg: float = 0.0
    tip_bias_deg: float = 0.0
    tip_scale: float = 1.0
    tip_delay_s: float = 0.0
    torque_bias_n_mm: float = 0.0
    tip_clock_ratio: float = 1.0
    torque_clock_ratio: float = 1.0
    torque_low_pass_s: float = 0.0
    torque_butterworth_s: float = 0.0
    torque_average_s: float = 0.0
    torque_scale: float = 1.0
    torque_delay_s: float = 0.0
    drive_friction_n_mm: float = 0.0
    presliding_deg: float = PRESLIDING_DEG
    base_scale: float = 1.0
    inserted_offset_mm: float = 0.0
    offset_free_share: float = 0.0
    material_share_constant_depth: float = 0.0
    material_share_growing_depth: float = 0.0
    pasts: tuple[Past, ...] = ()
    clock_starts: tuple[ClockStart, ...] = ()
    jumps: tuple[ReadingJump, ...] = ()
    smoothed: tuple[SmoothedReading, ...] = ()
    free: FreeLaw | None = None

    def needle(self, rig: NominalRig) -> Needle:
        """The needle; each trial has a length of its own, which is in its set-up."""
        nominal = dict(rig.needle)
        nominal["shear_modulus_gpa"] *= self.stiffness_scale
        needle = Needle(
            **nominal,
            tip_drag_n_mm_s_per_rad=self.tip_drag_n_mm_s_per_rad,
            curvature_n_mm_per_mm=self.curvature_n_mm_per_mm,
            curvature_phase_deg=self.curvature_phase_deg,
            load_coefficient=self.load_coefficient,
            tip_inertia_kg_m2=rig.inertia.tip_kg_m2,
        )
        return self.free.needle(needle) if self.free else needle

    def tissue(self, rig: NominalRig) -> Tissue:
        """The tissue; with two layers, the total damping is the nominal one."""
        damping = rig.tissue.damping_n_mm_s_per_mm * self.damping_scale
        if self.layer_ratio == 1.0:
            layers: tuple[Layer, ...] = (Layer(interface=self._interface(damping)),)
        else:
            boundary, ratio = self.layer_boundary_fraction, self.layer_ratio
            shallow = damping / (boundary + ratio * (1 - boundary))
            layers = (
                Layer(interface=self._interface(shallow), fraction=boundary),
                Layer(interface=self._interface(ratio * shallow)),
            )
        tissue = Tissue(layers=layers, entry_friction_n_mm=self.entry_friction_n_mm)
        return self.free.tissue(tissue) if self.free else tissue

    def _interface(self, damping: float) -> Interface:
        return Interface(
            viscous_n_mm_s_per_mm=damping,
            exponent=self.rate_exponent,
            plateau_rad_s=self.plateau_rad_s,
            kinetic_n_mm_per_mm=self.kinetic_n_mm_per_mm,
            static_n_mm_per_mm=self.kinetic_n_mm_per_mm + self.static_excess_n_mm_per_mm,
            stribeck_rad_s=self.stribeck_rad_s,
            shared_n_mm_per_mm=self.shared_n_mm_per_mm,
            stiffness_n_mm_per_rad_per_mm=self.tissue_stiffness_n_mm_per_rad_per_mm or None,
            time_constant_s=self.tissue_time_constant_s,
            dragged_ratio=self.tissue_dragged_ratio,
        )

    def drive(self, rig: NominalRig) -> Drive:
        """The drive, with chuck and sheath."""
        drive = Drive(
            rotor_inertia_kg_m2=rig.inertia.base_kg_m2,
            stiffness_n_mm_per_rad=self.base_stiffness_n_mm_per_rad or None,
            backlash_deg=self.backlash_deg,
            sheath_friction_n_mm_per_mm=self.sheath_friction_n_mm_per_mm,
        )
        return self.free.drive(drive) if self.free else drive

    @property
    def slides_dry(self) -> bool:
        """Whether there is dry friction anywhere, which gives before it slides."""
        levels = (
            self.kinetic_n_mm_per_mm,
            self.static_excess_n_mm_per_mm,
            self.shared_n_mm_per_mm,
            self.entry_friction_n_mm,
            self.sheath_friction_n_mm_per_mm,
            self.load_coefficient,
            self.drive_friction_n_mm,
        )
        return any(level > 0.0 for level in levels)

    @cached_property
    def without_sensors(self) -> "RigParameters":
        """The same rig with ideal sensors."""
        return replace(
            self,
            tip_bias_deg=0.0,
            tip_scale=1.0,
            tip_delay_s=0.0,
            torque_bias_n_mm=0.0,
            tip_clock_ratio=1.0,
            torque_clock_ratio=1.0,
            clock_starts=(),
            torque_low_pass_s=0.0,
            torque_butterworth_s=0.0,
            torque_average_s=0.0,
            torque_scale=1.0,
            torque_delay_s=0.0,
            drive_friction_n_mm=0.0,
            smoothed=(),
            jumps=tuple(jump for jump in self.jumps if jump.sensor == BASE),
            free=self.free.without_sensors() if self.free else None,
        )

    def past_of(self, trial: str) -> Past:
        """The past of a trial that began late."""
        return next((past for past in self.pasts if past.trial == trial), Past(trial=trial))

    def on_trial(self, trial: str) -> "RigParameters":
        """The rig for one trial, without the pasts, clocks and jumps of others."""
        own = tuple(past for past in self.pasts if past.trial == trial)
        clocks = tuple(clock for clock in self.clock_starts if clock.trial == trial)
        jumps = tuple(jump for jump in self.jumps if jump.trial == trial)
        free = self.free.on_trial(trial) if self.free else None
        if (own, clocks, jumps) == (self.pasts, self.clock_starts, self.jumps) and free is self.free:
            return self
        return replace(self, pasts=own, clock_starts=clocks, jumps=jumps, free=free)

    def setup(
        self,
        rig: NominalRig,
        schedule: Schedule,
        *,
        elements: int,
        step_s: float,
        past_s: float = 0.0,
    ) -> Setup:
        """The MuJoCo needle for a schedule, as returned by `driven`.

        Args:
          past_s: of the schedule, that comes before the trial.
        """
        shaft = max(schedule.longest_mm, 1.0)
        at_start = float(schedule.inserted_mm[0]), float(schedule.drive[0])
        begun = self.free.begun_at(*at_start, past_s) if self.free else None
        needle, tissue, drive = _parts(self if begun is self.free else replace(self, free=begun), rig)
        standing = schedule.mesh is Mesh.EULERIAN
        inserted = schedule.inserted_mm[0] if standing else shaft - schedule.free_mm[0]
        return Setup(
            needle=needle,
            tissue=tissue,
            drive=drive,
            # A mesh that goes with the needle has the free length in it as well.
            discretisation=_siblings(
                elements if standing else 2 * elements, step_s, self.presliding_deg
            ),
            mesh=schedule.mesh,
            free_mm=float(schedule.free_mm[0]),
            inserted_mm=float(inserted),
            rows=LAW_ROWS + (self.free.more_rows if self.free else 0),
            slip_share=self.material_share_constant_depth
            if standing
            else self.material_share_growing_depth,
        )


@lru_cache(maxsize=128)  # trial after trial asks for the same
def _parts(parameters: RigParameters, rig: NominalRig) -> tuple[Needle, Tissue, Drive]:
    return parameters.needle(rig), parameters.tissue(rig), parameters.drive(rig)


@lru_cache(maxsize=64)
def _siblings(elements: int, step_s: float, presliding_deg: float) -> Discretisation:
    return Discretisation(
        step_s=step_s,
        elements=elements,
        arrangement=Arrangement.SIBLINGS,
        presliding_deg=presliding_deg,
    )


NOMINAL = RigParameters()
"""The rig that rig.yaml describes."""
