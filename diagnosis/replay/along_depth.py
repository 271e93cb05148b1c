"""A law that changes with the depth, as layers of tissue.

The parts are equally thick. They either share the inserted length, and grow with it, or lie at fixed
depths below the surface, as layers of a real tissue do: a shallow trial then meets only the first. Or
the second of two begins at the depth at which a trial began.
"""

from dataclasses import dataclass, replace
from itertools import zip_longest

from models.errors import InvalidValue
from models.tissue import THINNEST_MM, Interface, Layer


@dataclass(frozen=True, kw_only=True)
class AlongDepth:
    """What each part of the depth has, from the surface on; empty: as in the nominal tissue.

    Attributes:
      damping: factors of the viscous torque.
      stiffness: factors of the stiffness, if the tissue is elastic.
      friction_n_mm_per_mm: dry friction in addition to the nominal one.
      shared: whether that is shared with the axial motion.
      thickness_mm: of each part; the last takes the rest. 0: the parts share the inserted length.
      thicknesses_mm: of each part but the last, where they differ; empty: they do not.
      from_start: whether there are two parts, the first down to where a trial began.

    Raises:
      InvalidValue: a factor of the damping, a thickness, or the number of parts is not allowed.
    """

    damping: tuple[float, ...] = ()
    stiffness: tuple[float, ...] = ()
    friction_n_mm_per_mm: tuple[float, ...] = ()
    shared: bool = False
    thickness_mm: float = 0.0
    thicknesses_mm: tuple[float, ...] = ()
    from_start: bool = False

    def __post_init__(self) -> None:
        if min(self.damping, default=1.0) <= 0:
            raise InvalidValue("damping", self.damping, "factors above 0")
        if min(self.friction_n_mm_per_mm, default=0.0) < 0:
            expected = "levels of at least 0"
            raise InvalidValue("friction_n_mm_per_mm", self.friction_n_mm_per_mm, expected)
        if self.thickness_mm < 0:
            raise InvalidValue("thickness_mm", self.thickness_mm, "a thickness, or 0")
        if self.thicknesses_mm and (
            len(self.thicknesses_mm) != self.parts - 1 or min(self.thicknesses_mm) <= 0
        ):
            expected = f"{self.parts - 1} thicknesses above 0, of all parts but the last"
            raise InvalidValue("thicknesses_mm", self.thicknesses_mm, expected)

        if self.from_start and (self.parts != 2 or self.thickness_mm or self.thicknesses_mm):
            raise InvalidValue("from_start", True, "two parts without a thickness, or False")

    @property
    def parts(self) -> int:
        """Number of parts; 0: nothing changes with the depth."""
        return max(len(own) for own in (self.damping, self.stiffness, self.friction_n_mm_per_mm))

    def times(self, strength: float) -> "AlongDepth":
        """Factors raised to a power, and friction multiplied."""
        return AlongDepth(
            damping=tuple(factor**strength for factor in self.damping),
            stiffness=tuple(factor**strength for factor in self.stiffness),
            friction_n_mm_per_mm=tuple(strength * level for level in self.friction_n_mm_per_mm),
            shared=self.shared,
            thickness_mm=self.thickness_mm,
            thicknesses_mm=self.thicknesses_mm,
            from_start=self.from_start,
        )

    def in_trial(self, begun_mm: float) -> "AlongDepth":
        """That of a trial which began at a depth: its first part is so thick."""
        if not self.from_start:
            return self
        return replace(self, from_start=False, thicknesses_mm=(max(begun_mm, THINNEST_MM),))

    def layers(self, law: Interface) -> tuple[Layer, ...]:
        """Layers of tissue, each with the law of the nominal one, changed.

        Those from the start of a trial are of one in particular (`in_trial`); else they share.
        """
        elastic = law.stiffness_n_mm_per_rad_per_mm
        each = zip_longest(self.damping, self.stiffness, self.friction_n_mm_per_mm)
        *upper, last = (
            law.but(
                viscous_n_mm_s_per_mm=_times(damping, law.viscous_n_mm_s_per_mm),
                stiffness_n_mm_per_rad_per_mm=None if elastic is None else _times(stiffness, elastic),
                **self._dry(law, level or 0.0),
            )
            for damping, stiffness, level in each
        )
        return (
            *(Layer(interface=own, **size) for own, size in zip(upper, self._sizes(), strict=True)),
            Layer(interface=last),
        )

    def _dry(self, law: Interface, level: float) -> dict[str, float]:
        if self.shared:
            return {"shared_n_mm_per_mm": law.shared_n_mm_per_mm + level}
        return {
            "kinetic_n_mm_per_mm": law.kinetic_n_mm_per_mm + level,
            "static_n_mm_per_mm": law.static_level_n_mm_per_mm + level,
        }

    def _sizes(self) -> list[dict[str, float]]:
        """Of all parts but the last."""
        if self.thicknesses_mm:
            return [{"thickness_mm": own} for own in self.thicknesses_mm]
        same = {"thickness_mm": self.thickness_mm} if self.thickness_mm else {"fraction": 1 / self.parts}
        return [same] * (self.parts - 1)


def _times(factor: float | None, nominal: float) -> float:
    return nominal if factor is None else factor * nominal
