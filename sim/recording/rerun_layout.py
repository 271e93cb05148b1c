"""The layout with which rerun's viewer shows a recording.

Output only: nothing that computes imports this module.
"""

from typing import Any

import rerun.blueprint as rrb

from sim.recording.recording import Recording

APPLICATION = "needle-torsion"
_ALONG = ", over depth in mm"


def application(recording: Recording) -> str:
    """Name of the application: the viewer keeps one layout for each, so recordings with other views
    get another name."""
    return APPLICATION + "".join(
        f"-{name}" for name, there in _optional_views(recording).items() if there
    )


def _optional_views(recording: Recording) -> dict[str, bool]:
    """Which of the optional views a recording has."""
    return {
        "shaft": recording.group("shaft").size > 0,
        "tissue": recording.group("tissue").size > 0,
        "control": "rate_limited_count" in recording.table,
    }


def blueprint(recording: Recording) -> Any:
    """Needle above tissue on the left, plots in the middle, text on the right."""
    plots = [
        rrb.TimeSeriesView(origin="/angles", name="Angles, deg"),
        rrb.TimeSeriesView(origin="/torque", name="Torque, N mm"),
        rrb.TimeSeriesView(origin="/modes", name="Modal amplitudes, deg"),
        rrb.TimeSeriesView(origin="/lengths", name="Lengths, mm"),
    ]
    left: list[Any] = [rrb.Spatial3DView(origin="/world", name="Needle")]
    there = _optional_views(recording)
    if there["shaft"]:
        left.append(rrb.BarChartView(origin="/profile/shaft", name=f"Lag behind the base, deg{_ALONG}"))
    if there["tissue"]:
        left.append(rrb.BarChartView(origin="/profile/tissue", name=f"Twist of the tissue, deg{_ALONG}"))
    if there["control"]:
        plots.append(rrb.TimeSeriesView(origin="/limits", name="Limits reached"))
        plots.append(rrb.TimeSeriesView(origin="/estimate", name="Modes of the estimator, deg"))
    checks = [
        rrb.TimeSeriesView(origin="/energy", name="Energy, mJ"),
        rrb.TimeSeriesView(origin="/stress", name="Shear stress, MPa"),
        rrb.TimeSeriesView(origin="/speed", name="Speed, mm/s"),
        rrb.TimeSeriesView(origin="/correction", name="Correction to second order, N mm"),
        rrb.TimeSeriesView(origin="/solver", name="Solver"),
    ]
    text = rrb.TextDocumentView(origin="/about", name="About")
    return rrb.Blueprint(
        rrb.Horizontal(
            rrb.Vertical(*left, row_shares=[2] + [1] * (len(left) - 1)),
            rrb.Tabs(
                rrb.Vertical(*plots, name="Motion"),
                rrb.Vertical(*checks, name="Energy, stress, solver"),
            ),
            text,
            column_shares=[3, 4, 2],
        ),
        collapse_panels=True,
    )
