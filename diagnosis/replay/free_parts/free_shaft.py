"""What a free-form law changes of the shaft of the needle."""

from dataclasses import dataclass, replace

from diagnosis.replay.free_parts.free_grip import weaker
from models.needle import Needle


@dataclass(frozen=True, kw_only=True)
class FreeShaft:
    """Another shaft; as it stands, the nominal one. Fields are named as those of the needle.

    Attributes:
      stiffness_curve: factors of its stiffness over the torque (models.needle).
      stiffness_torque_n_mm: torque at the last of them.
      stiffness_along: its factors at even places from the tip on (models.needle).
      stiffness_along_mm: from the tip to the last of them.
      yield_torque_n_mm: torque beyond which it twists plastically (models.needle); None: never.
      yield_stiffness_ratio: its stiffness beyond it over the elastic one.
      creep_ratio: twist that a torque adds in time, over the elastic one (models.needle).
      creep_time_s: in which it does.
      damping_time_s: damping of its material over its stiffness (models.needle).
      joint_play_deg: play of a joint in it (models.needle); 0: there is none.
      joint_length_mm: shaft that twists as much as it, a spring (models.needle); 0: it is stiff.
      joint_from_tip_mm: where it is.
      tip_inertia_kg_m2: of what turns with its tip, besides that of the rig.
    """

    stiffness_curve: tuple[float, ...] = ()
    stiffness_torque_n_mm: float = 0.0
    stiffness_along: tuple[float, ...] = ()
    stiffness_along_mm: float = 0.0
    yield_torque_n_mm: float | None = None
    yield_stiffness_ratio: float = 0.0
    creep_ratio: float = 0.0
    creep_time_s: float = 0.0
    damping_time_s: float = 0.0
    joint_play_deg: float = 0.0
    joint_length_mm: float = 0.0
    joint_from_tip_mm: float = 0.0
    tip_inertia_kg_m2: float = 0.0

    def times(self, strength: float) -> "FreeShaft":
        """The change multiplied by a strength; factors are raised to a power."""
        return replace(
            self,
            stiffness_curve=tuple(factor**strength for factor in self.stiffness_curve),
            stiffness_along=tuple(factor**strength for factor in self.stiffness_along),
            yield_torque_n_mm=weaker(self.yield_torque_n_mm, strength),
            creep_ratio=strength * self.creep_ratio,
            damping_time_s=strength * self.damping_time_s,
            joint_play_deg=strength * self.joint_play_deg,
            joint_length_mm=strength * self.joint_length_mm,
            tip_inertia_kg_m2=strength * self.tip_inertia_kg_m2,
        )

    def of(self, needle: Needle) -> Needle:
        """The needle with this shaft."""
        own = vars(self) | {"tip_inertia_kg_m2": needle.tip_inertia_kg_m2 + self.tip_inertia_kg_m2}
        changed: Needle = needle.but(**own)
        return changed
