"""Possible causes of the deviation in the steered insertion of Figs. 11 and 12.

Each hypothesis has one parameter, or none. If the paper states or suggests a value, that is
one hypothesis, and the same mechanism with the value that fits Fig. 12 is another.

    prebend       a tip bent by alpha has to follow a channel of radius R. In a rigid channel,
                  a quarter turn takes the torque EI alpha / R; EI = kappa (1 + nu) for a round wire.
                  Once with the channel that the tip cuts on its way, once with MuJoCo's own law,
                  a torque per mm inserted that always prefers the first orientation.
    tip drag      the bent length L sweeps through the tissue. At radius y = x sin alpha its drag
                  per mm and speed is twice that along the shaft (a slender body), beta / r^2:
                  2 beta / r^2 sin^2 alpha L^3 / 3.

In the experiments of Figs. 3 to 5 the tip was outside the tissue, so nothing acts on it there.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from diagnosis.effects.effect import Parameter
from diagnosis.replay.rig_parameters import RigParameters
from models import published
from models.bevel import PREBENT_RADIUS_MM
from models.materials import (
    slope_per_mm,
    tissue_stiffness_n_mm_per_rad_per_mm,
    tissue_time_constant_s,
)
from models.needle import NITINOL
from studies.published.criteria import INSERTION_SCAN
from studies.published.experiments.base_turn import TURN_DEG, BaseTurn
from studies.published.experiments.channel import PREBENT_MM
from studies.published.experiments.insertion import InsertionRig

_PREBEND_RAD = math.radians(15.0)  # Section V
_POISSON = 0.33  # of Nitinol
SLOW_TURN_SHAFT_MM = 230.0 + 100.0
"""From base to exit in the slow turns (Section II-A)."""
_TWIST_TEST_MM = published.TWIST_TEST_LENGTH.value


@dataclass(frozen=True, kw_only=True)
class InsertionHypothesis:
    """One mechanism in the stated rig of Figs. 11 and 12.

    Attributes:
      name: in words.
      basis: origin of its value; empty if it is fitted to Fig. 12.
      parameter: parameter that is fitted to Fig. 12; None: none.
      of_tables: whether it is based on a fit to Tables II, IV and V.
      scan: values of the parameter that are simulated first.
      apply: returns the rig for a value of the parameter (which is ignored if there is none).
    """

    name: str
    basis: str = ""
    parameter: Parameter | None = None
    of_tables: bool = False
    scan: int = INSERTION_SCAN
    apply: Callable[[float], InsertionRig]


def _model(**changes: Any) -> InsertionRig:
    return InsertionRig(model=replace(RigParameters(), **changes))


def _of_model(field: str) -> Callable[[float], InsertionRig]:
    return lambda value: _model(**{field: value})


def prebend_torque_n_mm() -> float:
    """Torque of a quarter turn of the prebent tip in a rigid channel, N mm."""
    bending_n_mm2 = NITINOL.rigidity_n_mm2 * (1 + _POISSON)
    return bending_n_mm2 * _PREBEND_RAD / PREBENT_RADIUS_MM


def prebend_drag_n_mm_s() -> float:
    """Viscous torque of the prebent length that sweeps through plastisol, N mm s / rad."""
    damping = slope_per_mm(dict(published.DAMPING_PLASTISOL_N_MM_S))
    across = 2 * damping / NITINOL.radius_mm**2
    return across * math.sin(_PREBEND_RAD) ** 2 * PREBENT_MM**3 / 3


def _fitted(unit: str, low: float, high: float) -> Parameter:
    return Parameter(name="value", unit=unit, low=low, high=high, start=(low,), logarithmic=True)


_GELATIN = slope_per_mm(dict(published.STATIC_TORQUE_GELATIN_N_MM))
_DRY = ("dry friction along the shaft", "kinetic_n_mm_per_mm", "N mm / mm")
_SHARED = ("friction shared with axial speed", "shared_n_mm_per_mm", "N mm / mm")
_BENT = ("prebent tip that keeps to its first channel", "curvature_n_mm_per_mm", "N mm / mm")
_DRAG = ("drag of the prebent tip", "tip_drag_n_mm_s_per_rad", "N mm s / rad")

STATED_INSERTION = InsertionHypothesis(
    name="stated", basis="viscous, Table II", apply=lambda _: InsertionRig()
)


def _at(mechanism: tuple[str, str, str], value: float, basis: str) -> InsertionHypothesis:
    name, field, unit = mechanism
    return InsertionHypothesis(
        name=name, basis=f"{value:.3g} {unit}: {basis}", apply=lambda _: _of_model(field)(value)
    )


def _set_by_figure_12(mechanism: tuple[str, str, str], low: float, high: float) -> InsertionHypothesis:
    name, field, unit = mechanism
    return InsertionHypothesis(name=name, parameter=_fitted(unit, low, high), apply=_of_model(field))


ALL_INSERTION_HYPOTHESES: tuple[InsertionHypothesis, ...] = (
    STATED_INSERTION,
    InsertionHypothesis(
        name="no friction at all",
        basis="only the turning time of the base",
        apply=lambda _: _model(damping_scale=1e-4),
    ),
    InsertionHypothesis(
        name="yielding tissue",
        basis="Section IV-A2",
        apply=lambda _: _model(
            tissue_stiffness_n_mm_per_rad_per_mm=tissue_stiffness_n_mm_per_rad_per_mm(),
            tissue_time_constant_s=tissue_time_constant_s(),
        ),
    ),
    _set_by_figure_12(("larger damping", "damping_scale", "-"), 1.0, 10.0),
    _at(_DRY, _GELATIN, "gelatin, Table II"),
    _set_by_figure_12(_DRY, 1e-3, 0.2),
    _at(_SHARED, _GELATIN, "gelatin, Table II"),
    _set_by_figure_12(_SHARED, 1e-3, 3.0),
    InsertionHypothesis(
        name="prebent tip in the channel that it cuts",
        basis=f"{prebend_torque_n_mm():.2g} N mm: a rigid channel",
        apply=lambda _: InsertionRig(channel_n_mm=prebend_torque_n_mm()),
    ),
    _set_by_figure_12(_BENT, 0.01, 1.0),
    _at(_DRAG, prebend_drag_n_mm_s(), "a slender body"),
    _set_by_figure_12(_DRAG, 0.05, 4.0),
    InsertionHypothesis(
        name="longer shaft",
        basis="330 mm, base to exit in the slow turns (Section II-A)",
        apply=lambda _: InsertionRig(shaft_mm=SLOW_TURN_SHAFT_MM),
    ),
    InsertionHypothesis(
        name="longer shaft",
        basis="410 mm, as in the twist test",
        apply=lambda _: InsertionRig(shaft_mm=_TWIST_TEST_MM),
    ),
    InsertionHypothesis(
        name="longer shaft",
        parameter=_fitted("mm", 120.0, 500.0),
        apply=lambda length: InsertionRig(shaft_mm=length),
    ),
    InsertionHypothesis(
        name="slower base, alone",
        parameter=_fitted("deg/s", 60.0, 300.0),
        apply=lambda rate: InsertionRig(turn=BaseTurn(time_s=TURN_DEG / rate)),
    ),
)
