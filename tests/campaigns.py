"""Campaigns of short insertions, and another process that runs one."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def content(**changes):
    """A campaign file of six insertions of 0.3 s: two depths, three draws each."""
    base = {
        "name": "short",
        "tissue": "soft-plastisol",
        "free_mm": 50.0,
        "inserted_mm": 100.0,
        "through": True,
        "discretisation": {"elements": 8},
        "segments": [{"duration_s": 0.2, "turn_deg": 60}, {"duration_s": 0.1}],
    }
    campaign = {
        "name": "few",
        "kind": "insertion",
        "base": base,
        "vary": {
            "inserted_mm": {"grid": [80.0, 120.0]},
            "segments.0.turn_deg": {"normal": [60.0, 5.0]},
        },
        "samples": 3,
        "seed": 7,
        "cases_per_piece": 2,
    }
    return campaign | changes


def environment():
    return os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{ROOT / 'tests'}"}


def start_command(*arguments):
    """`needle campaign` in a process of its own, which leads a group."""
    command = [sys.executable, "-m", "scripts.main", "campaign", *map(str, arguments)]
    return subprocess.Popen(command, cwd=ROOT, env=environment(), stderr=subprocess.DEVNULL)
