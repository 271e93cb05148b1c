"""A needle so stiff that all of it turns as its base does: its twist is below 0.02 deg."""

import numpy as np
import pytest

from models.contact import CONTACT_POINTS, ContactCurve
from models.drive import Drive
from models.needle import NITINOL
from sim.discretisation import Arrangement, Discretisation
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

STIFF = NITINOL.but(shear_modulus_gpa=1e6)
LENGTH_MM, STEP_S = 60.0, 0.01
ARRANGEMENTS = pytest.mark.parametrize("arrangement", list(Arrangement))


def turned(tissue, time_s, drive_deg, *, arrangement=Arrangement.SIBLINGS, drive=None):
    same = np.ones(time_s.size)
    setup = Setup(
        needle=STIFF,
        tissue=tissue,
        drive=drive or Drive(),
        free_mm=10.0,
        inserted_mm=LENGTH_MM,
        discretisation=Discretisation(elements=8, step_s=STEP_S, arrangement=arrangement),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=drive_deg,
        free_mm=10.0 * same,
        inserted_mm=LENGTH_MM * same,
        speed_mm_s=0.0 * same,
    )
    return simulate([setup], inputs)[0]


def curve(over, scale, last, steepness, **more):
    factors = np.exp(steepness * np.linspace(0, 1, CONTACT_POINTS) ** 2)
    return ContactCurve(over=over, scale=scale, last=last, factors=tuple(factors), **more)


def factor(own, at):
    """The curve in between: straight in the logarithms."""
    u = np.log1p(own.places / own.scale)
    return np.exp(np.interp(np.log1p(at / own.scale), u, np.log(own.factors)))
