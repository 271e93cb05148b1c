"""One run for all tests of recordings."""

import pytest

from sim.experiment import perform
from sim.paper_protocols import protocol_named


@pytest.fixture(scope="session")
def recording():
    """A fast turn 10 cm deep while the needle slides; the last 6 of its 8 s of rest are left out."""
    full = protocol_named("fig5-10cm")
    first, turn, rest = full.segments
    short = rest.but(duration_s=2.0, advance_mm=-5.0)
    return perform(full.but(segments=(first, turn, short)))
