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


def posterior(**changes):
    """What a report knows of a rig with dry friction: its level, and a stiffness."""
    rig = {
        "format": "rig-log/1",
        "needle": {"diameter_mm": 0.59, "shear_modulus_gpa": 27.2, "density_g_cm3": 6.45},
        "tissue": {"damping_n_mm_s_per_mm": 0.0172},
        "sensors": {
            "tip_angle_noise_deg": 0.3,
            "base_torque_noise_n_mm": 0.02,
            "base_angle_noise_deg": 0.02,
        },
        "trials": [{"file": "trial_01.csv"}],
    }
    known = {
        "rig": rig,
        "parameters": ["coulomb_friction.level", "stiffness_error.scale"],
        "values": [0.0015, 1.0],
        "bounds": [[1e-6, 0.05], [0.3, 3.0]],
        "matrix": [[2.25e-8, 0.0], [0.0, 1e-4]],
    }
    return known | changes


def environment():
    return os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{ROOT / 'tests'}"}


def start_command(*arguments):
    """`needle campaign` in a process of its own, which leads a group."""
    command = [sys.executable, "-m", "scripts.main", "campaign", *map(str, arguments)]
    return subprocess.Popen(command, cwd=ROOT, env=environment(), stderr=subprocess.DEVNULL)
