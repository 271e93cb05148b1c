"""Effects of the tissue against the statics of a shaft that sticks to it, and of steady turning."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from models.needle import NITINOL
from validation.rig.simulation import ideal_signals
from validation.rig.unmodelled.tissue import EFFECTS

KAPPA, STUCK, STIFFNESS, END = NITINOL.rigidity_n_mm2, 1.0, 0.02, 20.0
YIELDS = {"stiffness": STIFFNESS, "time_constant": 0.05}
LAWS = {
    "softening_tissue": (
        {"share": 0.6, "time": 8.0},
        lambda x, twist: twist * (1 - 0.6 * (1 - math.exp(-END / 8.0))),
    ),
    "stiffening_depth": ({"growth": 4.0}, lambda x, twist: twist * (1 + 4.0 * x / 100)),
    "hardening_tissue": ({"angle": 5.0}, lambda x, twist: twist * (1 + (twist / math.radians(5)) ** 2)),
}


def test_a_damping_gradient_keeps_the_torque_and_moves_its_lever(at_end, steady):
    """The moment of a damping 1 + g (2 x / l - 1) about the entry is l^2/2 (1 + g/3)."""
    torque, tip, _ = at_end(damping_gradient={"gradient": 0.6})
    assert torque == pytest.approx(steady.torque, rel=1e-4)
    more = math.degrees(steady.beta * steady.rate * steady.depth**2 / 2 * 0.6 / 3 / KAPPA)
    assert at_end()[1] - tip == pytest.approx(more, rel=1e-3)


@pytest.mark.parametrize("name", LAWS)
def test_a_shaft_that_sticks_is_held_by_the_law_of_the_tissue(drive, make_rig, steady, name):
    """At rest torque' = -law(x, angle) and angle' = -torque / kappa, from the tip to the chuck.

    The presliding of the friction, 0.1 deg per N mm / mm, and the retardation (0.05 s against 8 s) each
    give way by less than 1 % of the twist.
    """
    others, law = LAWS[name]

    def held(time_s):
        return 30 * np.clip(time_s / 2, 0, 1)

    rig = make_rig({name: YIELDS | others}, coulomb_friction={"level": STUCK})
    signals = ideal_signals(rig, drive(held, dt=0.01, end=END))
    statics = solve_ivp(
        lambda x, y: (-STIFFNESS * law(x, y[1]), -y[0] / KAPPA),
        (steady.depth, 0.0),
        (0.0, math.radians(signals.tip_deg[-1])),
        rtol=1e-8,
    )
    torque, entry = statics.y[:, -1]
    assert signals.torque_n_mm[-1] == pytest.approx(torque, rel=0.01)
    assert math.degrees(entry + torque * steady.free / KAPPA) == pytest.approx(30, rel=0.01)
    plain = ideal_signals(
        make_rig(
            tissue_viscoelasticity=YIELDS,
            coulomb_friction={"level": STUCK},
        ),
        drive(held, dt=0.01, end=END),
    )
    assert abs(plain.torque_n_mm[-1] - torque) > 0.05 * torque


@pytest.mark.parametrize("name", LAWS)
def test_both_meshes_have_the_same_tissue(drive, make_rig, name):
    """At a depth that hardly grows; bounds are an eighth of the noise of a rig's sensors."""
    rig = make_rig({name: YIELDS | LAWS[name][0]})
    fixed = ideal_signals(rig, drive())
    moving = ideal_signals(rig, drive(speed=1e-5, growing=True))
    assert moving.tip_deg == pytest.approx(fixed.tip_deg, abs=0.05)
    assert moving.torque_n_mm == pytest.approx(fixed.torque_n_mm, abs=0.002)
    plain = ideal_signals(make_rig(tissue_viscoelasticity=YIELDS), drive())
    assert np.abs(plain.tip_deg - fixed.tip_deg).max() > 0.5


def test_all_change_the_law():
    assert all(effect.law for effect in EFFECTS.values())
