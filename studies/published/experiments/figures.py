"""The published figures as measurements: the experiment of each, and its standard deviation.

Tables II, IV and V print 28 figures beside their depths:

    8   percentages, computed from the others
    8   of the torsion compensator, whose gains and motor the paper does not state:
        printed beside ours, but not used to test the rig
    8   of the plastisol and its drive: damping in a slow turn at rest (4), settling and
        integral of the base-only turn (4)
    4   of another material: the torque that gelatin holds

The paper prints no standard deviations. That of a column of Table II is its scatter about
the line through the origin that model (7) assumes, so Table II cannot test that
line. Tables IV and V get their rounding and 5 % of the figure (`criteria.RELATIVE_SIGMA`).
Figures count as independent, although settling and integral at one depth come from
one curve (the mean of three trials).
"""

import math

import numpy as np

from models import published
from models.materials import slope_per_mm
from studies.published.criteria import RELATIVE_SIGMA
from studies.published.experiments.measurement import MeasuredFigure, Quantity, TurnExperiment

_BASE_ONLY = 0  # column of Tables IV and V


def column_scatter(by_depth_cm: dict[float, float]) -> float:
    """Standard deviation of a column of Table II about its line through the origin."""
    slope = slope_per_mm(by_depth_cm)
    residual = [value - slope * 10 * depth for depth, value in by_depth_cm.items()]
    return float(np.sqrt(np.square(residual).sum() / (len(residual) - 1)))


def gelatin() -> tuple[MeasuredFigure, ...]:
    """The torque that gelatin holds, at four depths."""
    column = dict(published.STATIC_TORQUE_GELATIN_N_MM)
    return _table_ii(column, TurnExperiment.HELD_TURN, Quantity.HELD_TORQUE, "N mm")


def plastisol(relative_sigma: float = RELATIVE_SIGMA) -> tuple[MeasuredFigure, ...]:
    """Damping at four depths, settling and integral of the base-only turn at two.

    Args:
      relative_sigma: share of a figure of Tables IV and V that is one standard deviation.
    """
    column = dict(published.DAMPING_PLASTISOL_N_MM_S)
    tables = (
        ("Table IV", Quantity.SETTLING, published.TABLE_IV_SETTLE_S, "s", 0.01),
        ("Table V", Quantity.INTEGRAL, published.TABLE_V_INTEGRAL_DEG_S, "s deg", 0.1),
    )
    return (
        *_table_ii(column, TurnExperiment.SLOW_TURN, Quantity.DAMPING, "N mm s"),
        *(
            MeasuredFigure(
                source=source,
                experiment=TurnExperiment.QUICK_TURN,
                quantity=quantity,
                depth_mm=10 * depth,
                value=row[_BASE_ONLY],
                unit=unit,
                sigma=math.hypot(relative_sigma * row[_BASE_ONLY], digit / math.sqrt(12)),
                sigma_source=f"{100 * relative_sigma:g} % and rounding",
            )
            for source, quantity, table, unit, digit in tables
            for depth, row in table.items()
        ),
    )


def _table_ii(
    column: dict[float, float], experiment: TurnExperiment, quantity: Quantity, unit: str
) -> tuple[MeasuredFigure, ...]:
    return tuple(
        MeasuredFigure(
            source="Table II",
            experiment=experiment,
            quantity=quantity,
            depth_mm=10 * depth,
            value=value,
            unit=unit,
            sigma=column_scatter(column),
            sigma_source="scatter of the column about its line through the origin",
        )
        for depth, value in column.items()
    )
