"""A free-form law in a rig: torques, angles and readings that no effect of the library has.

A curve runs smoothly through its values at some places of a variable and is level beyond them. It acts
on what its name says:

    tissue          the torque of tissue that varies is times the curve
    drive_angle     the needle is turned by the drive shaft's angle + the curve, deg
    drive_slip      the needle is left behind by the curve, deg/s, at the chuck
    drive_torque    the torque sensor reads the curve beside what the needle takes, N mm
    tip_reading     the tip sensor reads the tip's angle + the curve, deg
    torque_reading  the torque sensor reads the torque + the curve, N mm

A curve over the past says how much a reading shows of what was so long ago in place of what is,

    reading += sum over places of value (what was, then - what is).

A curve over what was turned by since turning back adds hysteresis (Prandtl-Ishlinskii),

    += sum over places r of value z_r,    z_r <- clamp(z_r + change, -r, r).

What depends on the rate, angle or place of each piece of the shaft by itself is a law of the tissue.
"""

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import zip_longest
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import PchipInterpolator

from diagnosis.replay.bearing import stopped_at
from diagnosis.replay.variables import OF_THE_NEEDLE, Variable, of_inputs, of_needle
from models.errors import InvalidValue
from models.needle import Needle
from models.tissue import Interface, Layer, Tissue
from sim.schedule import Schedule

Array = NDArray[np.float64]

_LEAST_FACTOR = 1e-3
_MOST_SIDED = 0.99  # asymmetry
_TORQUES = ("viscous_n_mm_s_per_mm", "kinetic_n_mm_per_mm", "orientation_n_mm_per_mm")


class ActsOn(StrEnum):
    """What a curve changes."""

    TISSUE = "tissue"
    DRIVE_ANGLE = "drive_angle"
    DRIVE_SLIP = "drive_slip"
    DRIVE_TORQUE = "drive_torque"
    TIP_READING = "tip_reading"
    TORQUE_READING = "torque_reading"


_SENSORS = (ActsOn.DRIVE_TORQUE, ActsOn.TIP_READING, ActsOn.TORQUE_READING)


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A curve of one variable.

    Attributes:
      places: increasing, of the variable.
      values: at the places.
      period: of the variable, after which the curve repeats; 0: none.
      trial: the only trial that it is in; empty: all.

    Raises:
      InvalidValue: places do not increase or are farther apart than the period, values are not as many,
        or a factor of the tissue's torque is not positive.
    """

    acts_on: ActsOn
    variable: Variable
    places: tuple[float, ...]
    values: tuple[float, ...]
    period: float = 0.0
    trial: str = ""

    def __post_init__(self) -> None:
        places = np.asarray(self.places, float)
        if places.size < 2 or not (np.diff(places) > 0).all() or not np.isfinite(places).all():
            raise InvalidValue("places", self.places, "at least two finite numbers, increasing")
        if len(self.values) != places.size or not np.isfinite(self.values).all():
            raise InvalidValue(
                "values", self.values, f"{places.size} finite numbers, one for each place"
            )
        if self.acts_on is ActsOn.TISSUE and min(self.values) <= 0:
            raise InvalidValue(
                "values", self.values, "factors above 0, because the curve multiplies the tissue"
            )
        if self.period and self.period <= places[-1] - places[0]:
            raise InvalidValue("period", self.period, "0, or more than the places span")

    def at(self, x: Array) -> Array:
        """The curve at values of its variable, (N,)."""
        if self.period:
            places = (*self.places, self.places[0] + self.period)
            wrapped = self.places[0] + np.mod(x - self.places[0], self.period)
            return np.asarray(PchipInterpolator(places, (*self.values, self.values[0]))(wrapped))
        within = np.clip(x, self.places[0], self.places[-1])
        return np.asarray(PchipInterpolator(self.places, self.values)(within))

    def with_hysteresis(self, values: Array) -> Array:
        """What hysteresis adds to an angle or a torque, (N,): stop operators (Prandtl-Ishlinskii)."""
        each = zip(self.places, self.values, strict=True)
        return np.asarray(np.sum([share * stopped_at(values, limit) for limit, share in each], axis=0))

    def times(self, strength: float) -> "Curve":
        """The curve so many times as strong; of a factor, raised to that power."""
        if self.acts_on is ActsOn.TISSUE:
            return replace(self, values=tuple(value**strength for value in self.values))
        return replace(self, values=tuple(value * strength for value in self.values))

    def of_past(self, time_s: Array, values: Array) -> Array:
        """What a sensor shows of the past beside what is, (N,)."""
        each = zip(self.places, self.values, strict=True)
        shown = [share * (np.interp(time_s - ago, time_s, values) - values) for ago, share in each]
        return np.asarray(np.sum(shown, axis=0))


@dataclass(frozen=True, kw_only=True)
class FreeLaw:
    """What is free of a rig.

    Attributes:
      curves: of variables that a trial has one value of at a time.
      tissue_varies: whether the torque of the nominal tissue is times a curve.
      asymmetry: of it (models.tissue).
      rate_curve: factors of its viscous torque (models.tissue).
      rate_range_rad_s: that they span.
      damping_along_depth: factors of its viscous torque in equal parts of the inserted length.
      stiffness_along_depth: of its stiffness, where it is elastic, in as many parts.
      stiffness_over_torque: factors of the shaft's stiffness (models.needle).
      stiffness_torque_n_mm: at the last of them.
      throughout, at_tip: further laws (models.tissue).

    Raises:
      InvalidValue: a field is none of an `Interface`, or a factor of the damping is not positive.
    """

    curves: tuple[Curve, ...] = ()
    tissue_varies: bool = False
    asymmetry: float = 0.0
    rate_curve: tuple[float, ...] = ()
    rate_range_rad_s: tuple[float, float] = (0.01, 10.0)
    damping_along_depth: tuple[float, ...] = ()
    stiffness_along_depth: tuple[float, ...] = ()
    stiffness_over_torque: tuple[float, ...] = ()
    stiffness_torque_n_mm: float = 0.0
    throughout: tuple[Interface, ...] = ()
    at_tip: tuple[Interface, ...] = ()

    def __post_init__(self) -> None:
        Interface(
            asymmetry=self.asymmetry,
            rate_curve=self.rate_curve,
            rate_range_rad_s=self.rate_range_rad_s,
        )
        if min(self.damping_along_depth, default=1.0) <= 0:
            raise InvalidValue("damping_along_depth", self.damping_along_depth, "factors above 0")

    @property
    def more_rows(self) -> int:
        """Of the law table, beside those of any rig."""
        parts = max(len(self.damping_along_depth), len(self.stiffness_along_depth))
        return len(self.throughout) + len(self.at_tip) + parts

    def times(self, strength: float) -> "FreeLaw":
        """The law so many times as strong; 0 is none of it, 1 the law itself.

        What is added to an angle, a reading or a torque is multiplied; factors are raised to a power.
        """
        return FreeLaw(
            curves=tuple(curve.times(strength) for curve in self.curves),
            tissue_varies=self.tissue_varies,
            asymmetry=max(min(self.asymmetry * strength, _MOST_SIDED), -_MOST_SIDED),
            rate_curve=tuple(factor**strength for factor in self.rate_curve),
            rate_range_rad_s=self.rate_range_rad_s,
            damping_along_depth=tuple(factor**strength for factor in self.damping_along_depth),
            stiffness_along_depth=tuple(factor**strength for factor in self.stiffness_along_depth),
            stiffness_over_torque=tuple(factor**strength for factor in self.stiffness_over_torque),
            stiffness_torque_n_mm=self.stiffness_torque_n_mm,
            throughout=tuple(_stronger(law, strength) for law in self.throughout),
            at_tip=tuple(_stronger(law, strength) for law in self.at_tip),
        )

    def on_trial(self, trial: str) -> "FreeLaw":
        """What one trial sees."""
        return replace(self, curves=tuple(c for c in self.curves if c.trial in ("", trial)))

    def without_sensors(self) -> "FreeLaw":
        """What the needle feels."""
        return replace(self, curves=tuple(c for c in self.curves if c.acts_on not in _SENSORS))

    def needle(self, needle: Needle) -> Needle:
        """The needle with the law in it."""
        changed: Needle = needle.but(
            stiffness_curve=self.stiffness_over_torque,
            stiffness_torque_n_mm=self.stiffness_torque_n_mm,
        )
        return changed

    def tissue(self, tissue: Tissue) -> Tissue:
        """The tissue with the law in it.

        Where damping changes along the depth, the layers are those of the first.
        """
        layers = tissue.layers
        if self.damping_along_depth or self.stiffness_along_depth:
            layers = self._along_depth(layers[0].interface)
        changes: dict[str, Any] = {"varies": self.tissue_varies, "asymmetry": self.asymmetry}
        if self.rate_curve:
            changes |= {"rate_curve": self.rate_curve, "rate_range_rad_s": self.rate_range_rad_s}
        shaped = tuple(layer.but(interface=layer.interface.but(**changes)) for layer in layers)
        whole: Tissue = tissue.but(layers=shaped, throughout=self.throughout, at_tip=self.at_tip)
        return whole

    def _along_depth(self, law: Interface) -> tuple[Layer, ...]:
        each = zip_longest(self.damping_along_depth, self.stiffness_along_depth, fillvalue=1.0)
        stiffness = law.stiffness_n_mm_per_rad_per_mm
        laws = [
            law.but(
                viscous_n_mm_s_per_mm=damping * law.viscous_n_mm_s_per_mm,
                stiffness_n_mm_per_rad_per_mm=None if stiffness is None else factor * stiffness,
            )
            for damping, factor in each
        ]
        share = 1.0 / len(laws)
        return (*(Layer(interface=own, fraction=share) for own in laws[:-1]), Layer(interface=laws[-1]))

    def driven(self, inputs: Schedule, start_s: float, torque_n_mm: Array) -> Schedule:
        """What is done to the needle, and how its tissue varies.

        Args:
          torque_n_mm: as measured, without its noise; what the chuck carries is not known before.
        """
        factor, drive = np.ones(inputs.time_s.size), inputs.drive
        for curve in self.curves:
            if curve.acts_on in _SENSORS:
                continue
            if curve.variable is Variable.TURNED_BY:
                drive = drive + curve.with_hysteresis(inputs.drive)
                continue
            of_torque = curve.variable is Variable.TORQUE
            own = curve.at(torque_n_mm if of_torque else of_inputs(curve.variable, inputs, start_s))
            if curve.acts_on is ActsOn.TISSUE:
                factor = factor * own
            elif curve.acts_on is ActsOn.DRIVE_SLIP:
                drive = drive - cumulative_trapezoid(own, inputs.time_s, initial=0)
            else:
                drive = drive + own
        return replace(inputs, drive=drive, tissue_factor=np.maximum(factor, _LEAST_FACTOR))

    def sensed(
        self, inputs: Schedule, start_s: float, tip_deg: Array, torque_n_mm: Array
    ) -> tuple[Array, Array]:
        """What tip and torque read beside themselves, (N,) each."""
        read = {True: np.zeros(tip_deg.size), False: np.zeros(torque_n_mm.size)}
        for curve in self.curves:
            if curve.acts_on in _SENSORS:
                of_tip = curve.acts_on is ActsOn.TIP_READING
                own = tip_deg if of_tip else torque_n_mm
                if curve.variable is Variable.PAST:
                    more = curve.of_past(inputs.time_s, own)
                elif curve.variable is Variable.TURNED_BY:
                    more = curve.with_hysteresis(own)
                elif curve.variable in OF_THE_NEEDLE:
                    more = curve.at(of_needle(curve.variable, inputs.time_s, tip_deg, torque_n_mm))
                else:
                    more = curve.at(of_inputs(curve.variable, inputs, start_s))
                read[of_tip] = read[of_tip] + more
        return read[True], read[False]


def _stronger(law: Interface, strength: float) -> Interface:
    """A further law, its torques multiplied."""
    stronger: Interface = law.but(**{name: strength * getattr(law, name) for name in _TORQUES})
    return stronger
