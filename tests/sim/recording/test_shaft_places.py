"""Nodes of the shaft: the entry is at 0, the chuck one free length before it, the tip at the depth."""

import numpy as np
import pytest

from sim.experiment import perform
from sim.paper_protocols import protocol_named
from sim.recording.shaft_places import node_places_mm

SHORT = [{"duration_s": 0.1, "turn_deg": 9}]


@pytest.fixture(scope="module")
def standing():
    """A needle that neither goes in nor out."""
    return perform(protocol_named("fig4-10cm").but(segments=SHORT))


@pytest.mark.parametrize("name", ["recording", "standing"])
def test_chuck_and_tip_are_where_the_recording_says(name, request):
    recording = request.getfixturevalue(name)
    places = node_places_mm(recording)
    assert places.shape == recording.group("shaft").shape
    np.testing.assert_allclose(places[:, 0], -recording["free_mm"], atol=1e-6)
    np.testing.assert_allclose(places[:, -1], recording["inserted_mm"], atol=1e-6)
    assert (np.diff(places, axis=1) > 0).all()
