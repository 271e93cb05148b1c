"""A coupling that is stiffer one way than the other, against its closed form.

Turned steadily, the needle takes the torque damping * length * rate, and its base lags by torque over
the stiffness of that way.
"""

import numpy as np
import pytest

from models.drive import Drive
from models.needle import Needle
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

NEEDLE = Needle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45)
DAMPING, LENGTH_MM, RATE_DEG_S, STIFFNESS, RATIO = 0.017, 60.0, 40.0, 12.0, 0.35


@pytest.mark.parametrize("arrangement", Arrangement)
@pytest.mark.parametrize(("way", "stiffness"), [(1, STIFFNESS), (-1, RATIO * STIFFNESS)])
def test_turned_steadily_the_base_lags_by_torque_over_stiffness(
    way: int, stiffness: float, arrangement: Arrangement
) -> None:
    time_s = np.linspace(0.0, 12.0, 1201)
    same = np.ones(time_s.shape)
    setup = Setup(
        needle=NEEDLE,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING),
        drive=Drive(stiffness_n_mm_per_rad=STIFFNESS, unwinding_ratio=RATIO),
        free_mm=10.0,
        inserted_mm=LENGTH_MM,
        discretisation=Discretisation(elements=16, step_s=0.01, arrangement=arrangement),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=way * RATE_DEG_S * time_s,
        free_mm=10.0 * same,
        inserted_mm=LENGTH_MM * same,
        speed_mm_s=0.0 * same,
    )
    run = simulate([setup], inputs)[0]
    torque = way * DAMPING * LENGTH_MM * np.radians(RATE_DEG_S)
    assert run.base_torque_n_mm[-1] == pytest.approx(torque, rel=1e-6)
    lag_deg = inputs.drive[-1] - run.base_deg[-1]
    assert lag_deg == pytest.approx(np.degrees(torque / stiffness), rel=1e-6)
