"""The twist of a recorded shaft in the modes of the closed form."""

import numpy as np

from models.modes import InsertedNeedle
from models.needle import NITINOL
from sim.experiment import perform
from sim.paper_protocols import protocol_named
from sim.recording.modal_amplitudes import modal_amplitudes_deg


def test_modal_amplitudes_are_those_of_the_closed_form():
    viscous = protocol_named("fig5-10cm").but(
        tissue="viscous-plastisol",
        segments=[{"duration_s": 0.3, "turn_deg": 90}, {"duration_s": 2}],
        discretisation={"elements": 32},
    )
    recording = perform(viscous)
    held = InsertedNeedle(
        needle=NITINOL,
        damping_n_mm_s_per_mm=viscous.tissue.layers[0].interface.viscous_n_mm_s_per_mm,
        inserted_mm=100,
        free_mm=50,
    )
    exact = held.respond(recording["time_s"], np.radians(recording["base_angle_deg"]))
    amplitudes = modal_amplitudes_deg(recording)
    assert np.abs(amplitudes[:, 0] - np.degrees(exact.modes_rad[:, 0])).max() < 0.05


def test_without_damping_there_are_no_modes_to_show():
    short = [{"duration_s": 0.1, "turn_deg": 9}]
    dry = perform(protocol_named("fig4-10cm").but(segments=short))
    assert modal_amplitudes_deg(dry) is None
