"""Tables IV and V on the MuJoCo needle: every depth, both free lengths."""

from models.materials import MATERIALS
from studies.control.comparison import StepResponse, compare
from studies.control.step_response import DAMPING, DESIGN

__all__ = ["CONTROLLERS", "DAMPING", "DEPTHS_CM", "DESIGN", "FREE_MM", "tables_iv_v"]

DEPTHS_CM = (5.0, 10.0, 20.0)
FREE_MM = (0.0, 50.0)
CONTROLLERS = (
    "base_only_at_limit",
    "base_only",
    "feedforward",
    "feedback",
    "paper_reading",
    "lqr",
    "least_time",
)


def tables_iv_v() -> list[StepResponse]:
    """Tables IV and V: every depth, both free lengths."""
    viscous = MATERIALS["viscous-plastisol"]
    return [
        response
        for depth in DEPTHS_CM
        for free in FREE_MM
        for response in compare(
            viscous, depth_cm=depth, free_mm=free, controllers=CONTROLLERS, design=DESIGN
        )
    ]
