"""The result of a simulation, from the outputs of its steps; what cannot be trusted is refused."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import DriveKind
from models.errors import NeedleError
from sim.kernel import memory_map
from sim.needles.setup import Setup
from sim.schedule import Schedule

Array = NDArray[np.float64]

_LANDING_TOLERANCE_RAD = 1e-8
_ROUNDING = float(np.finfo(np.float64).eps)
_SAME_TIME = 1e-6  # of a step


class SimulationFailed(NeedleError):
    """A run stopped early, or its results cannot be trusted."""


@dataclass(frozen=True, kw_only=True)
class Run:
    """The result of a simulation: N samples, n + 1 nodes.

    Attributes:
      inputs: the inputs at the ends of the steps.
      outputs: (N, memory_map.OUTPUTS), SI, as the model's sensors return them.
      angles_rad: (N, n + 1), or None if they were not kept.
      tissue_rad: (N, rows, n, 2) twist of the tissue at its sites, or None.
      unconverged: number of stages whose iteration did not converge; 0 in a good run.
    """

    setup: Setup
    inputs: Schedule
    outputs: Array
    angles_rad: Array | None = None
    tissue_rad: Array | None = None

    @property
    def time_s(self) -> Array:
        """Ends of the steps, s, (N,); the first is the start."""
        return self.inputs.time_s

    @property
    def tip_deg(self) -> Array:
        """Angle of the tip, deg, (N,)."""
        return self.outputs[:, memory_map.O_TIP_ANGLE] / units.DEG

    @property
    def base_deg(self) -> Array:
        """Angle of the needle at the chuck, deg, (N,)."""
        return self.outputs[:, memory_map.O_BASE_ANGLE] / units.DEG

    @property
    def shaft_deg(self) -> Array:
        """Angle of the drive shaft, deg, (N,); of the needle's base if the drive gives torque."""
        driven_by_angle = self.setup.drive.kind is DriveKind.ANGLE
        return self.inputs.drive if driven_by_angle else self.base_deg

    @property
    def slip_deg(self) -> Array:
        """Angle by which the needle has slipped in the chuck so far, deg, (N,)."""
        return self.outputs[:, memory_map.O_CHUCK_SLIP] / units.DEG

    @property
    def base_torque_n_mm(self) -> Array:
        """Torque of the drive on the needle, N mm, (N,)."""
        return self.outputs[:, memory_map.O_BASE_TORQUE] / units.N_MM

    def since(self, start_s: float) -> "Run":
        """The run from a time on; the same run if it begins there."""
        kept = self.time_s >= start_s - _SAME_TIME * self.setup.discretisation.step_s
        if kept.all():
            return self
        return replace(
            self,
            inputs=self.inputs.rows(kept),
            outputs=self.outputs[kept],
            angles_rad=None if self.angles_rad is None else self.angles_rad[kept],
            tissue_rad=None if self.tissue_rad is None else self.tissue_rad[kept],
        )

    @property
    def unconverged(self) -> int:
        """Number of stages whose iteration did not converge."""
        return int(self.outputs[-1, memory_map.O_FAILED])


def run_of(
    setup: Setup,
    inputs: Schedule,
    start: Array,
    ctrl: Array,
    outputs: Array,
    shape: dict[str, Array],
) -> Run:
    """The run from the joints `start` with the inputs `ctrl`, given the outputs after the start."""
    outputs[0] = _at_rest(setup, start, ctrl)
    if setup.drive.kind is DriveKind.ANGLE and setup.discretisation.order > 1:
        _centre_inertia(outputs)
    refuse_untrustworthy(outputs, inputs.time_s, setup)
    if not shape:
        return Run(setup=setup, inputs=inputs, outputs=outputs)
    angles = np.vstack([start[1:], shape["qpos"][:, 1:]])
    if setup.is_chain:
        angles = np.cumsum(angles, axis=1)
    return Run(
        setup=setup,
        inputs=inputs,
        outputs=outputs,
        angles_rad=angles,
        tissue_rad=_tissue(setup, shape["userdata"]),
    )


def refuse_untrustworthy(outputs: Array, time_s: Array, setup: Setup) -> None:
    """Checks that every run has to pass, with and without MuJoCo's steps.

    Raises:
      SimulationFailed: outputs are not finite, or MuJoCo's step did not end where the callback's did.
    """
    if not np.isfinite(outputs).all():
        bad = time_s[np.flatnonzero(~np.isfinite(outputs).all(axis=1))[0]]
        raise SimulationFailed(
            f"expected finite outputs, found NaN or infinity at {bad:.3f} s; take a smaller step "
            f"than {setup.discretisation.step_s:.3g} s, or check the tissue's parameters"
        )
    landing, tolerance = float(outputs[-1, memory_map.O_LANDING]), _landing_tolerance_rad(setup, outputs)
    if landing > tolerance:
        raise SimulationFailed(
            f"expected MuJoCo's step to end within {tolerance:.0e} rad of the angles "
            f"that the callback computed, found {landing:.1e} rad; remove any other passive "
            "callback, and change nothing in the model but its stiffness, inertia, servos and step"
        )


def _landing_tolerance_rad(setup: Setup, outputs: Array) -> float:
    """What rounding alone may do, where that is more than the usual tolerance.

    A spring k turned by theta rounds its torque to eps k theta, and in a step h that moves an element
    of inertia I by h^2 / I times as much. With k / I = c^2 / a^2, the speed c of torsional waves and
    the length a of the element, this is eps (c h / a)^2 theta: much for thin needles and long steps.
    """
    travelled_mm = setup.needle.wave_speed_m_s * setup.discretisation.step_s / units.MM
    elements = (travelled_mm / float(np.diff(setup.nodes_mm).min())) ** 2
    ends = outputs[:, [memory_map.O_BASE_ANGLE, memory_map.O_TIP_ANGLE]]
    return max(_LANDING_TOLERANCE_RAD, _ROUNDING * elements * float(np.abs(ends).max()))


def _centre_inertia(outputs: Array) -> None:
    """Assign the inertia's share of the base torque to its sample, in place.

    A step computes it for its start, so the share of a sample is known only in the step after it.
    """
    inertia = outputs[:, memory_map.O_INERTIA]
    outputs[:-1, memory_map.O_BASE_TORQUE] += inertia[1:] - inertia[:-1]


def _at_rest(setup: Setup, start: Array, ctrl: Array) -> Array:
    """The outputs at the start, before anything has moved."""
    row = np.zeros(memory_map.OUTPUTS)
    row[[memory_map.O_BASE_ANGLE, memory_map.O_TIP_ANGLE]] = start[1]
    row[memory_map.O_TIP_TORQUE] = ctrl[memory_map.U_TIP]
    if setup.drive.kind is DriveKind.TORQUE:
        row[memory_map.O_BASE_TORQUE] = ctrl[memory_map.U_DRIVE]
    return row


def _tissue(setup: Setup, userdata: Array) -> Array:
    n, rows = setup.nodes_mm.size - 1, len(setup.law)
    size = memory_map.block(n, rows)
    at = memory_map.CLOCK + size + memory_map.sites_at(n)
    sites = userdata[:, at : at + memory_map.SITE * 2 * n * rows].reshape(
        -1, rows, n, 2, memory_map.SITE
    )
    twist: Array = sites[..., memory_map.PHI]
    return np.concatenate([np.zeros((1, *twist.shape[1:])), twist])
