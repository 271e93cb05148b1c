"""A free-form law in a rig: torques, angles and readings that no effect of the library has.

What its curves act on:

    tissue          the torque of tissue that varies is multiplied by the curve
    orientation     so is that of laws of the shaft's angle which vary; the curve may be negative
    stiffness       so is the stiffness of the shaft: tissue that varies resists by so much less, and the
                    needle's torque is so much larger; exact without other torques and inertia
    tissue_angle    the tissue turns by the curve, deg, and takes the needle with it: as seen from the
                    tissue, the drive shaft turns by so much less; exact without friction elsewhere
    tissue_slip     it turns at the rate of the curve, deg/s, in the same way
    drive_angle     the needle is turned by the drive shaft's angle + the curve, deg
    drive_slip      the needle slips at the chuck at the rate of the curve, deg/s
    inserted_length as much more of the shaft is inserted as the curve says, mm, and less is free
                    over advanced_by: hysteresis, as of a surface that is dragged along
    free_length     the shaft before the tissue is longer by the curve, mm
    tip_torque      the tip is turned by a torque as the curve says, N mm
    drive_torque    the torque sensor reads the needle's torque + the curve, N mm
    tip_reading     the tip sensor reads the tip's angle + the curve, deg
    torque_reading  the torque sensor reads the torque + the curve, N mm
    tip_gain        the tip sensor reads the tip's angle times the curve
    torque_gain     the torque sensor reads the torque times the curve

Dependence on the rate, angle or place of each piece of the shaft is a law of the tissue.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.curve import Curve
from diagnosis.replay.free_parts.free_coupling import FreeCoupling
from diagnosis.replay.free_parts.free_grip import FreeGrip
from diagnosis.replay.free_parts.free_play import FreePlay
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.free_parts.merged import merged
from diagnosis.replay.free_parts.strength import raised, stronger, stronger_kerfs
from diagnosis.replay.sensing.curve_sums import OF_SENSORS, driven_by, readings_by
from diagnosis.replay.variables import Variable
from models.contact import ContactCurve
from models.drive import Drive
from models.kerf import Kerf
from models.needle import Needle
from models.tissue import Interface, Section, Tissue
from sim.schedule import Schedule

Array = NDArray[np.float64]

_MOST_SIDED = 0.99  # asymmetry
_ADDED = (
    "curves",
    "throughout",
    "from_start",
    "sections",
    "at_tip",
    "at_entry",
    "in_sheath",
    "plays",
    "kerfs",
)
_RECORDS = ("shaft", "grip", "coupling")
_OF_TORQUE = (Variable.TORQUE, Variable.PAST)  # curves of the drive


@dataclass(frozen=True, kw_only=True)
class FreeLaw:
    """All parts of a free-form law.

    Attributes:
      curves: curves over variables with one value at a time in a trial.
      tissue_varies: whether the torque of the nominal tissue is multiplied by a curve.
      stiffness_varies: whether its stiffness alone is, if it is elastic.
      asymmetry: asymmetry of the nominal tissue (models.tissue).
      viscosity_exponent: power of a curve of its stiffness by which its viscosity goes along.
      flows_at_deg: twist beyond which it flows, if it is elastic; None: it does not.
      rate_curve: factors of its viscous torque (models.tissue).
      rate_range_rad_s: range of rates that they span.
      along_depth: what changes with the depth.
      shaft: another shaft of the needle.
      contact: factors on the torque of the nominal tissue over what a contact has been through.
      grip: of the chuck, or of the tissue's holder, which gives way.
      throughout, sections, at_tip, at_entry: additional laws (models.tissue).
      from_start: additional laws like those throughout, whose angle is from where a trial starts.
      in_sheath: additional laws of the free shaft (models.drive).
      coupling: between drive and needle.
      plays: of the chuck, which works loose in a trial.
      kerfs: what holds the tip in the slit that it has cut (models.kerf).

    Raises:
      InvalidValue: a value is not allowed in an `Interface`.
    """

    curves: tuple[Curve, ...] = ()
    tissue_varies: bool = False
    stiffness_varies: bool = False
    asymmetry: float = 0.0
    viscosity_exponent: float = 1.0
    flows_at_deg: float | None = None
    rate_curve: tuple[float, ...] = ()
    rate_range_rad_s: tuple[float, float] = (0.01, 10.0)
    along_depth: AlongDepth = AlongDepth()  # noqa: RUF009 - frozen
    shaft: FreeShaft = FreeShaft()  # noqa: RUF009 - frozen
    contact: ContactCurve | None = None
    grip: FreeGrip = FreeGrip()  # noqa: RUF009 - frozen
    throughout: tuple[Interface, ...] = ()
    from_start: tuple[Interface, ...] = ()
    sections: tuple[Section, ...] = ()
    at_tip: tuple[Interface, ...] = ()
    at_entry: tuple[Interface, ...] = ()
    in_sheath: tuple[Interface, ...] = ()
    coupling: FreeCoupling = FreeCoupling()  # noqa: RUF009 - frozen
    plays: tuple[FreePlay, ...] = ()
    kerfs: tuple[Kerf, ...] = ()

    def __post_init__(self) -> None:
        Interface(
            asymmetry=self.asymmetry,
            rate_curve=self.rate_curve,
            rate_range_rad_s=self.rate_range_rad_s,
            viscosity_exponent=self.viscosity_exponent,
            flows_at_deg=self.flows_at_deg,
        )

    @property
    def more_rows(self) -> int:
        """Number of additional rows in the law table."""
        along = (self.throughout, self.from_start, self.sections)
        laws = (*along, self.at_tip, self.at_entry, self.in_sheath, self.kerfs)
        return sum(map(len, laws)) + self.along_depth.parts

    def times(self, strength: float) -> "FreeLaw":
        """The law multiplied by a strength: 0: no law, 1: the law itself.

        Terms added to an angle, reading or torque are multiplied; factors are raised to a power.
        """
        return FreeLaw(
            curves=tuple(curve.times(strength) for curve in self.curves),
            tissue_varies=self.tissue_varies,
            stiffness_varies=self.stiffness_varies,
            viscosity_exponent=self.viscosity_exponent,
            flows_at_deg=self.flows_at_deg / strength if self.flows_at_deg and strength else None,
            asymmetry=max(min(self.asymmetry * strength, _MOST_SIDED), -_MOST_SIDED),
            rate_curve=tuple(factor**strength for factor in self.rate_curve),
            rate_range_rad_s=self.rate_range_rad_s,
            along_depth=self.along_depth.times(strength),
            shaft=self.shaft.times(strength),
            grip=self.grip.times(strength),
            contact=raised(self.contact, strength) if self.contact else None,
            throughout=tuple(stronger(law, strength) for law in self.throughout),
            from_start=tuple(stronger(law, strength) for law in self.from_start),
            sections=tuple(
                own.but(interface=stronger(own.interface, strength)) for own in self.sections
            ),
            at_tip=tuple(stronger(law, strength) for law in self.at_tip),
            at_entry=tuple(stronger(law, strength) for law in self.at_entry),
            in_sheath=tuple(stronger(law, strength) for law in self.in_sheath),
            coupling=self.coupling.times(strength),
            plays=tuple(play.times(strength) for play in self.plays),
            kerfs=stronger_kerfs(self.kerfs, strength),
        )

    def beside(self, other: "FreeLaw") -> "FreeLaw":
        """Both laws at once: torques, angles and readings are added, factors multiplied.

        Raises:
          InvalidValue: both set a part of which a rig has one.
        """
        return merged(self, other, added=_ADDED, within=_RECORDS)

    def on_trial(self, trial: str) -> "FreeLaw":
        """The parts of the law that apply to one trial."""
        own = self._with(tuple(c for c in self.curves if c.trial in ("", trial)))
        if not self.plays:
            return own
        return replace(own, plays=tuple(play for play in self.plays if play.trial == trial))

    def begun_at(self, depth_mm: float, angle_deg: float, past_s: float) -> "FreeLaw":
        """The law in a trial that began at a depth and an angle of the drive shaft.

        Args:
          past_s: that is simulated before the trial.
        """
        along = self.along_depth.in_trial(depth_mm)
        begun = self if along is self.along_depth else replace(self, along_depth=along)
        if self.plays:
            begun = replace(begun, plays=tuple(play.after(past_s) for play in self.plays))
        if not self.from_start:
            return begun
        turned = (_turned(law, angle_deg) for law in self.from_start)
        return replace(begun, throughout=(*self.throughout, *turned), from_start=())

    def without_sensors(self) -> "FreeLaw":
        """The parts of the law that act on the needle, without those of the sensors."""
        return self._with(self._of_the_needle())

    def _with(self, curves: tuple[Curve, ...]) -> "FreeLaw":
        return self if len(curves) == len(self.curves) else replace(self, curves=curves)

    def _of_the_needle(self) -> tuple[Curve, ...]:
        return tuple(c for c in self.curves if c.acts_on not in OF_SENSORS)

    def needle(self, needle: Needle) -> Needle:
        """The needle with the law in it."""
        return self.shaft.of(needle)

    def drive(self, drive: Drive) -> Drive:
        """The drive with the law in it."""
        loosens = self.plays[0].loosening if self.plays else None
        coupled = self.coupling.of(self.grip.of(drive))
        changed: Drive = coupled.but(in_sheath=self.in_sheath, loosens=loosens)
        return changed

    def tissue(self, tissue: Tissue) -> Tissue:
        """The tissue with the law in it.

        If something changes with the depth, the new layers start from the law of the first layer.
        """
        layers = tissue.layers
        if self.along_depth.parts:
            layers = self.along_depth.layers(layers[0].interface)
        changes: dict[str, Any] = {
            "varies": self.tissue_varies,
            "stiffness_varies": self.stiffness_varies,
            "viscosity_exponent": self.viscosity_exponent,
            "flows_at_deg": self.flows_at_deg,
            "asymmetry": self.asymmetry,
            "contact": self.contact,
        }
        if self.rate_curve:
            changes |= {"rate_curve": self.rate_curve, "rate_range_rad_s": self.rate_range_rad_s}
        shaped = tuple(layer.but(interface=layer.interface.but(**changes)) for layer in layers)
        whole: Tissue = tissue.but(
            layers=shaped,
            throughout=self.throughout,
            sections=self.sections,
            at_tip=self.at_tip,
            at_entry=self.at_entry,
            kerfs=self.kerfs,
        )
        return whole

    @property
    def follows_torque(self) -> bool:
        """Whether the inputs of the needle depend on the torque."""
        return any(curve.variable in _OF_TORQUE for curve in self._of_the_needle())

    def driven(self, inputs: Schedule, start_s: float, torque_n_mm: Array) -> Schedule:
        """The inputs of the needle, with the variation of its tissue.

        Args:
          torque_n_mm: measured torque without its noise, since that of the simulation is not yet known.
        """
        curves = self._of_the_needle()
        if not curves:
            return inputs
        return driven_by(curves, inputs, start_s, torque_n_mm)

    def sensed(
        self, inputs: Schedule, start_s: float, tip_deg: Array, torque_n_mm: Array
    ) -> tuple[Array, Array]:
        """Terms to add to the readings of tip and torque, (N,) each."""
        return readings_by(self.curves, inputs, start_s, tip_deg, torque_n_mm)


def _turned(law: Interface, angle_deg: float) -> Interface:
    """A law of the angle from another one, deg."""
    phase_deg = law.orientation_phase_deg + law.orientation_cycles * angle_deg
    turned: Interface = law.but(orientation_phase_deg=phase_deg)
    return turned
