"""What a fit leaves beyond noise, of which a fault of the recording has to take off a part."""

from diagnosis.criteria.faults import FAULT_LEAST_SHARE
from diagnosis.fitting.fit import Fit


def cost_beyond_noise(fit: Fit) -> float:
    """Cost of the residual beyond that of noise.

    At least `FAULT_LEAST_SHARE` of that of noise: where a fit leaves nothing, a drift or a jump that
    takes off little is what chance makes of noise; what held-out trials object to is something else.
    """
    return max(fit.cost - fit.prior - fit.samples, FAULT_LEAST_SHARE * fit.samples)
