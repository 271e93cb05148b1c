"""The same run by other methods: scipy's solvers, and modes.

Each returns the times of its results, s, and the angle of the tip at these, deg. Solvers get what
makes them fast: compiled laws and Jacobians, banded if they accept it, and a restart at the corner
of the turn.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.integrate import odeint, solve_ivp
from scipy.signal import lfilter
from scipy.sparse import dia_array

from benchmarks import lumped_laws as laws
from benchmarks.tissues import DAMPING, END_S, LENGTH_MM, RIGIDITY, TURN_RAD, TURN_S, Case
from models.modes import InsertedNeedle, ramp
from models.needle import NITINOL

Array = NDArray[np.float64]
Answer = tuple[Array, Array]

RELAXATION_S = 3e-3  # of the rivals' dry friction: it costs them less than 0.001 deg
_DENSE_STATES = 64  # Radau's complex systems are solved densely up to here
_SAMPLES = 401  # of methods that are asked for times

_LAWS = {
    "viscous": (laws.smooth_rate, laws.smooth_jacobian),
    "Kelvin-Voigt": (laws.yielding_rate, laws.yielding_jacobian),
    "dry friction": (laws.dry_rate, laws.dry_jacobian),
}
_COMPILED = {name: tuple(njit(function) for function in pair) for name, pair in _LAWS.items()}


@dataclass(frozen=True, kw_only=True)
class Equations:
    """A case, cut into cells, as a right-hand side with its packed Jacobian.

    Attributes:
      law: what both take after time and state.
      states: of one cell.
      linear: the Jacobian is constant.
    """

    rate: Callable[..., Array]
    jacobian: Callable[..., Array]
    law: tuple[float, ...]
    cells: int
    states: int
    linear: bool

    @property
    def above(self) -> int:
        """Bands above the diagonal."""
        return self.states

    @property
    def below(self) -> int:
        """Bands below the diagonal."""
        return 2 * self.states - 1

    @property
    def start(self) -> Array:
        """Untwisted and at rest."""
        return np.zeros(self.cells * self.states)

    def tip_deg(self, states: Array) -> Array:
        """From the last two angles, the end being free, deg; states are (..., size)."""
        last, before = states[..., -self.states], states[..., -2 * self.states]
        return np.degrees((9 * last - before) / 8)


def equations(
    case: Case, cells: int, *, compiled: bool = True, relaxation_s: float = RELAXATION_S
) -> Equations:
    """The case as `benchmarks.lumped_laws` has it."""
    rate, jacobian = (_COMPILED if compiled else _LAWS)[case.name]
    law: tuple[float, ...] = (RIGIDITY / (LENGTH_MM / cells) ** 2, DAMPING)
    if case.stiffness > 0:
        law += (case.stiffness, case.time_constant_s)
    if case.level > 0:
        law += (case.level, case.yield_rad, relaxation_s)
    return Equations(
        rate=rate,
        jacobian=jacobian,
        law=law,
        cells=cells,
        states=1 if len(law) == 2 else 2,
        linear=case.level == 0,
    )


def by_odeint(system: Equations, tolerance: float, *, samples: int = _SAMPLES) -> Answer:
    """LSODA in one call: only the law is outside the compiled code."""
    time = np.linspace(0.0, END_S, samples)
    states = odeint(
        system.rate,
        system.start,
        time,
        args=system.law,
        Dfun=system.jacobian,
        tfirst=True,
        ml=system.below,
        mu=system.above,
        rtol=tolerance,
        atol=0.1 * tolerance,
        tcrit=[TURN_S],
        mxstep=100_000,
    )
    return time, system.tip_deg(states)


def by_solve_ivp(system: Equations, method: str, tolerance: float, *, restart: bool) -> Answer:
    """LSODA, BDF or Radau; answers at the solver's own steps."""
    jacobian = _jacobian_for(system, method)
    state, times, tips = system.start, [], []
    for span in ((0.0, TURN_S), (TURN_S, END_S)) if restart else ((0.0, END_S),):
        solution = solve_ivp(
            system.rate,
            span,
            state,
            method=method,
            args=system.law,
            rtol=tolerance,
            atol=0.1 * tolerance,
            **jacobian,
        )
        state = solution.y[:, -1]
        times.append(solution.t)
        tips.append(system.tip_deg(solution.y.T))
    return np.concatenate(times), np.concatenate(tips)


def _jacobian_for(system: Equations, method: str) -> dict[str, Any]:
    """As the method takes it: packed, or a matrix, which is constant if it may be."""
    if method == "LSODA":
        return {"jac": system.jacobian, "lband": system.below, "uband": system.above}
    size = system.start.size
    offsets = system.above - np.arange(system.above + system.below + 1)
    dense = method != "Radau" or size <= _DENSE_STATES

    def matrix(t: float, y: Array, *law: float) -> Any:
        banded = dia_array((system.jacobian(t, y, *law), offsets), shape=(size, size))
        return banded.toarray() if dense else banded.tocsc()

    return {"jac": matrix(0.0, system.start, *system.law) if system.linear else matrix}


def by_modes(count: int) -> Answer:
    """The exact propagator of `models.modes`, each mode as one recursive filter."""
    needle = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=DAMPING, inserted_mm=LENGTH_MM)
    time = np.linspace(0.0, END_S, _SAMPLES)
    base = ramp(time, by=TURN_RAD, duration_s=TURN_S)
    rate = np.diff(base, prepend=0.0) / time[1]
    poles, shares = needle.poles_rad_s(count), needle.participation(count)
    decay = np.exp(poles * time[1])
    gain = -shares * (decay - 1) / poles
    tip = base.copy()
    for k in range(count):
        tip += lfilter([gain[k]], [1.0, -decay[k]], rate)
    return time, np.degrees(tip)


def exact_tip_deg(time_s: Array) -> Array:
    """The closed form in viscous tissue, at any times, deg."""
    needle = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=DAMPING, inserted_mm=LENGTH_MM)
    every = np.union1d(time_s, [0.0, TURN_S])
    response = needle.respond(every, ramp(every, by=TURN_RAD, duration_s=TURN_S), count=200)
    return np.degrees(response.tip_rad[np.searchsorted(every, time_s)])


def converged_tip_deg(case: Case, *, cells: tuple[int, int] = (200, 400)) -> tuple[Array, Array, float]:
    """LSODA at tight tolerance on two grids, extrapolated (the scheme is second order).

    Returns times, s, the tip, deg, and the largest difference of the two grids, deg.
    """
    coarse, fine = (
        by_odeint(equations(case, n, relaxation_s=1e-5), 1e-9, samples=16_001)[1] for n in cells
    )
    time = np.linspace(0.0, END_S, fine.size)
    ratio = (cells[1] / cells[0]) ** 2
    return time, fine + (fine - coarse) / (ratio - 1), float(np.abs(fine - coarse).max())
