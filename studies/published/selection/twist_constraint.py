"""The paper's twist test (Section II-A): no fit uses it, but it rules out fits that contradict it.

1.24 N mm turned the base by 90 deg against a tip held 41 cm away: a measurement of
the shaft's own stiffness, in series with any compliance between drive and shaft.
"""

import math

from models import published
from studies.published.criteria import TWIST_RELATIVE_SIGMA, TWIST_SIGMAS
from studies.published.experiments.rig import STATED
from studies.published.fitting.fit import FigureFit


def twist_test_torque_n_mm(fit: FigureFit) -> float:
    """Base torque that the rig of a fit would have shown in the twist test, N mm."""
    model = fit.hypothesis.rig(fit.x).model
    length = published.TWIST_TEST_LENGTH.value
    compliance = length / model.needle(STATED).rigidity_n_mm2
    compliance += 1 / model.base_stiffness_n_mm_per_rad if model.base_stiffness_n_mm_per_rad else 0.0
    return math.radians(published.TWIST_TEST_ANGLE.value) / compliance


def contradiction(fit: FigureFit) -> str:
    """How the twist test contradicts a fit, in words; empty if it does not."""
    torque, measured = twist_test_torque_n_mm(fit), published.TWIST_TEST_TORQUE.value
    if abs(torque / measured - 1) <= TWIST_SIGMAS * TWIST_RELATIVE_SIGMA:
        return ""
    return f"the twist test of Section II-A measured {measured:g} N mm; predicted are {torque:.2f} N mm"
