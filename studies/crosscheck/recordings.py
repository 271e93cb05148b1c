"""Runs of the cross-check as recordings: fast turns beside their references, and Fig. 4."""

from functools import partial
from pathlib import Path

import pandas as pd

from sim.files import ResultSet
from sim.recording.recording import Recording, record
from sim.recording.rerun_log import log_recording
from studies.crosscheck import motion, turn
from studies.crosscheck.findings import Check

FILES = {free: f"turn_{free:g}mm_free.rrd" for free in turn.FREE_MM}
REVERSAL_FILE = "reversal.rrd"
NAMES = (*FILES.values(), REVERSAL_FILE)


def write_recordings(results: ResultSet, folder: Path) -> None:
    """Write all of `NAMES` as results of a folder; one that fails is left out."""
    for free, name in FILES.items():
        results.optional(folder / name, partial(_write_turn, free))
    results.optional(folder / REVERSAL_FILE, _write_reversal)


def _write_turn(free_mm: float, path: Path) -> None:
    checks = turn.compare(turn.turned(free_mm))
    log_recording(record_turn(free_mm), path, results=_said(checks))


def _write_reversal(path: Path) -> None:
    log_recording(record_reversal(), path, results=_said(motion.check_balances()))


def record_turn(free_mm: float) -> Recording:
    """The fast turn of our needle, with the tips of the native needle and of the closed form."""
    turned = turn.turned(free_mm)
    about = {
        "protocol": f"fast turn, {free_mm:g} mm free",
        "description": "90 deg in 0.3 s, 20 cm deep in viscous tissue; then held",
    }
    ours = record(turned.run, about)
    tips = {"closed_form_tip_deg": turned.exact_tip_deg, "native_tip_deg": turned.native_tip_deg}
    table = pd.concat([ours.table, pd.DataFrame(tips)], axis=1)
    return Recording(table=table, parameters=ours.parameters)


def record_reversal() -> Recording:
    """The run of Fig. 4 that the balances of torque and energy are taken from."""
    about = {
        "protocol": "fig4-10cm, tissue that yields",
        "description": "Fig. 4 at 10 cm in gelatin, elastic as plastisol: torque and energy balances",
    }
    return record(motion.reversal(motion.elastic_gelatin()), about)


def _said(checks: list[Check]) -> list[str]:
    return [f"{c.name}: {c.value:.2g} {c.unit} (must be {c.bounds})" for c in checks]
