"""Figures that the paper gives in words, beside computed ones: Figs. 3 and 5, and torque per lag.

As in `studies.crosscheck.paper`, nothing is tuned, and the notes explain differences, as far as
they are understood.
"""

import numpy as np

from models import published
from models.haptics import torque_n_mm_per_deg
from models.lag import lag_deg, twist_deg
from models.materials import tissue_named
from models.needle import NEEDLES, NITINOL
from sim.paper_protocols import protocol_named
from sim.simulation import simulate
from studies.crosscheck.findings import Comparison
from studies.crosscheck.paper import compare, settling_s

_TURN_DEG = 90.0
_SLOW_TURN_S, _SLOW_FREE_MM, _SLOW_DEPTH_MM = 20.0, 230.0, 100.0
_FIG_5_TURN_BEGINS_S, _FIG_5_ENDS_S = 1.0, 8.3  # in the protocol; after the turn began


def compare_text() -> list[Comparison]:
    """All of these figures."""
    return [*figure_3(), *figure_5(), *torque_feedback()]


def figure_3() -> list[Comparison]:
    """The lag at the end of the slow turn, 10 cm deep; the text gives no number for gelatin."""
    table_ii = published.DAMPING_PLASTISOL_N_MM_S[10.0] * np.radians(_TURN_DEG) / _SLOW_TURN_S
    own = lag_deg(NITINOL, base_torque_n_mm=table_ii, free_mm=_SLOW_FREE_MM, inserted_mm=_SLOW_DEPTH_MM)
    plastisol = (
        f"The torque of Table II at 10 cm gives {own:.1f} deg by eq. (2), and "
        f"{_at_exit_deg(table_ii):.1f} deg if all of it acted at the exit: Fig. 3 and Table II do not "
        "agree at the stated lengths"
    )
    circular = "its friction is calculated from this lag with eq. (2): not a test of the model"
    simtest = "simulated with the one torque that Section II-D states, 1.0 N mm"
    return [
        compare(f"Fig. 3, lag after the slow turn, {name}", figure, _slow_lag_deg(material), note)
        for name, material, figure, note in (
            ("soft plastisol", "soft-plastisol", published.FIG_3_PLASTISOL_LAG, plastisol),
            ("hard plastisol", "hard-plastisol", published.FIG_3_PLASTISOL_LAG, plastisol),
            ("chicken (sets its own friction)", "chicken", published.CHICKEN_LAG, circular),
            ("SimTest", "simtest", published.SIMTEST_LAG, simtest),
        )
    ]


def _at_exit_deg(torque_n_mm: float) -> float:
    """Lag if a torque acted where the needle leaves the tissue in the slow turns, deg: equation (1)."""
    return twist_deg(NITINOL, torque_n_mm=torque_n_mm, length_mm=_SLOW_FREE_MM + _SLOW_DEPTH_MM)


def _slow_lag_deg(material: str) -> float:
    protocol = protocol_named(f"fig3-{material}")
    run = simulate([protocol.setup()], protocol.schedule())[0]
    return float(np.interp(_SLOW_TURN_S, run.time_s, run.inputs.drive - run.tip_deg))


def figure_5() -> list[Comparison]:
    """The quick turn while retracting, 20 cm deep: settling time and final error of the tip."""
    protocol = protocol_named("fig5-20cm")
    yields = "with the spring and damper of Section IV-A2, tissue turns too and creeps back (0.2 rad/s)"
    slow = (
        "b = 3.45 N mm s is from slow turns without sliding; Tables IV and V show less in the quick turn"
    )
    rows = []
    for name, tissue, note in (
        ("soft plastisol as stated", tissue_named("soft-plastisol"), f"{slow}, and {yields}"),
        ("viscous alone", tissue_named("viscous-plastisol"), slow),
    ):
        run = simulate([protocol.but(tissue=tissue).setup()], protocol.schedule())[0]
        turning = run.time_s >= _FIG_5_TURN_BEGINS_S - 1e-9
        time, error = run.time_s[turning] - _FIG_5_TURN_BEGINS_S, _TURN_DEG - run.tip_deg[turning]
        rows += [
            compare(
                f"Fig. 5, 20 cm, {name}: within 3 deg",
                published.FIG_5_SETTLING,
                settling_s(time, error),
                note,
            ),
            *(
                compare(
                    f"Fig. 5, 20 cm, {name}: short of 90 deg after {at_s:g} s",
                    published.SETTLED_WITHIN,
                    float(np.interp(at_s, time, error)),
                    f"published: at most this; {note}",
                )
                for at_s in (published.FIG_5_SETTLING.value, _FIG_5_ENDS_S)
            ),
        ]
    return rows


def torque_feedback() -> list[Comparison]:
    """Section VI: torque per degree of lag, for a hand at the base or for a display."""
    note = "the torsional stiffness that Section VI would amplify; no gain or human threshold is stated"
    return [
        Comparison(
            item=f"base torque per degree of lag, {name}",
            published=torque.value / lag.value,
            ours=torque_n_mm_per_deg(needle, free_mm=free_mm, inserted_mm=inserted_mm),
            unit="N mm/deg",
            source="Section II-D",
            note=note,
        )
        for name, needle, free_mm, inserted_mm, torque, lag in (
            ("SimTest", NITINOL, 230, 100, published.SIMTEST_TORQUE, published.SIMTEST_LAG),
            (
                "1.27 mm Nitinol in tissue",
                NEEDLES["nitinol-1.27"],
                150,
                50,
                published.PODDER_TORQUE,
                published.PODDER_LAG,
            ),
        )
    ]
