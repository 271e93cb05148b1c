"""The rig against a second implementation of every law: `reference_rig`, plain numpy."""

import math

import numpy as np
import pytest
from reference_rig import Rig as ReferenceRig
from reference_rig import simulate

from validation.rig.simulation import CellCounts, simulate_twist

BETA, DEPTH = 0.018, 100.0
LAWS = {
    "coulomb": ({"coulomb_friction": {"level": 0.004}}, {}),
    "stiction": ({"stiction": {"kinetic": 0.002, "static": 0.005, "stribeck": 0.4}}, {}),
    "shared": ({"speed_dependent_friction": {"level": 0.01}}, {"speed": 2.0}),
    "thinning": ({"shear_thinning": {"exponent": 0.5}}, {}),
    "viscoelastic": ({"tissue_viscoelasticity": {"stiffness": 0.02, "time_constant": 0.5}}, {}),
    "layers": ({"layered_tissue": {"ratio": 4.0, "boundary": 0.43}}, {}),
    "load": (
        {"load_dependent_friction": {"coefficient": 0.4}, "tip_drag": {"damping": 0.2}},
        {"load": np.cos},
    ),
    "drive": (
        {
            "chuck_backlash": {"gap": 6.0},
            "base_compliance": {"stiffness": 8.0},
            "sheath_friction": {"level": 0.002},
            "entry_friction": {"level": 0.1},
        },
        {"speed": 2.0},
    ),
    "growing": (
        {
            "coulomb_friction": {"level": 0.002},
            "tissue_viscoelasticity": {"stiffness": 0.05, "time_constant": 0.2},
            "entry_friction": {"level": 0.1},
            "sheath_friction": {"level": 0.002},
            "needle_curvature": {"torque": 0.001, "phase": 50.0},
        },
        {"speed": 5.0, "growing": True},
    ),
}


@pytest.mark.parametrize("name", LAWS)
def test_effects_follow_the_reference(drive, make_rig, name):
    effects, how = LAWS[name]
    moved = drive(dt=0.01, end=1.5, free=DEPTH, **how)
    reference = simulate(
        ReferenceRig(
            diameter_mm=0.59, shear_modulus_gpa=27.2, damping_n_mm_s_per_mm=BETA, effects=effects
        ),
        time_s=moved.time_s,
        base_angle_deg=moved.base_deg,
        inserted_mm=moved.inserted_mm,
        free_mm=moved.free_mm,
        speed_mm_s=moved.speed_mm_s,
        tip_torque_n_mm=moved.tip_torque_n_mm,
        cells=40,
        dt=0.01,
        slip="material" if moved.growing else "place",
    )
    sheath = math.ceil(40 * moved.free_mm.max() / DEPTH)
    tip, torque = simulate_twist(make_rig(**effects).law(), moved, CellCounts(40, sheath, 40))
    nominal, _ = simulate_twist(make_rig().law(), moved, CellCounts(40, 0, 40))
    # Same steps and cells, so that only what the Newton methods leave (1e-7 rad) may differ. That
    # would not hide a wrong law: each changes the tip by far more.
    assert np.abs(np.degrees(tip - nominal)).max() > 1
    assert np.degrees(tip) == pytest.approx(reference.tip_angle_deg, abs=1e-3)
    assert torque == pytest.approx(reference.base_torque_n_mm, abs=1e-4)
