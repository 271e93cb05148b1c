"""Two simulated runs that estimators are tested on."""

import pytest
from estimated_runs import viscous_run


@pytest.fixture(scope="session")
def fast_turn():
    """Fig. 5 at 10 cm, with 3 s of rest: the slowest mode, 4.6 rad/s at most, has settled."""
    return viscous_run("fig5-10cm", step_s=0.002, rest_s=3.0)


@pytest.fixture(scope="session")
def insertion():
    """From the surface to 7 cm, with four half turns, to and fro."""
    return viscous_run("insertion", step_s=0.005)
