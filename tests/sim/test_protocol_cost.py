"""What a run would cost is told before it is computed."""

import pytest

from models.errors import InvalidValue
from sim.needles.kept import compile_model
from sim.protocol import Protocol, Segment
from sim.protocol_cost import MOST_BYTES, recorded_bytes, samples_of


def protocol(*segments, **changes):
    good = {"name": "test", "tissue": "viscous-plastisol", "free_mm": 50, "inserted_mm": 100}
    return Protocol(**(good | {"through": True, "segments": segments} | changes))


@pytest.mark.parametrize(
    ("segment", "changes", "said"),
    [
        ({"duration_s": 1e9}, {}, r"segments\.0\.duration_s: .*4 GB; 1e\+11 steps .*found 1000000000"),
        (
            {"duration_s": 1.0},
            {"discretisation": {"step_s": 1e-9}},
            r"duration_s: .* 1e\+09 steps of 1e-09",
        ),
        ({"duration_s": 600}, {"discretisation": {"elements": 1000}}, r"duration_s: .*fewer elements"),
        ({"duration_s": 1, "dither_deg": 1, "dither_hz": 1e9}, {}, r"segments\.0\.dither_hz: .*25 Hz"),
        ({"duration_s": 2500, "dither_deg": 1, "dither_hz": 20}, {}, r"dither_hz: .*1000000 samples"),
    ],
)
def test_what_would_not_end_is_refused_with_its_cost(segment, changes, said):
    with pytest.raises(InvalidValue, match=said):
        protocol(segment, **changes)


def test_a_segment_that_rounding_swallows_is_named():
    with pytest.raises(InvalidValue, match=r"segments\.1\.duration_s: .*told from 10 s"):
        protocol({"duration_s": 10}, {"duration_s": 1e-12})


def test_an_hour_of_the_usual_needle_is_a_protocol():
    hour = protocol({"duration_s": 3600, "turn_deg": 90})
    assert recorded_bytes(3600 / hour.discretisation.step_s, 17, 1) < MOST_BYTES


def test_the_cost_is_what_mujoco_records_of_a_run():
    short = protocol({"duration_s": 1.0})
    model = compile_model(short.setup())
    recorded = 8 * 100 * (model.nuserdata + model.nq + model.nsensordata)
    assert recorded_bytes(100, short.setup().nodes_mm.size - 1, 1) == pytest.approx(recorded, rel=0.01)


def test_a_wave_is_sampled_finely_and_a_line_at_its_ends():
    assert samples_of(Segment(duration_s=3)) == 2
    assert samples_of(Segment(duration_s=2, dither_deg=1, dither_hz=5)) == 321
