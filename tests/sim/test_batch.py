"""Many protocols in one call: each as if it were alone, to the last bit."""

import numpy as np
import pytest

from models.errors import InvalidValue
from sim import batch
from sim.batch import simulate_each
from sim.needles.run import SimulationFailed
from sim.paper_protocols import protocol_named
from sim.protocol import Segment
from sim.simulation import simulate

SHORT = protocol_named("fig5-10cm").but(
    segments=(Segment(duration_s=0.2, turn_deg=60), Segment(duration_s=0.3, advance_mm=-1))
)


def insertions():
    """Other tissues, needles, depths, motions, sizes and numbers of steps."""
    return [
        SHORT,
        SHORT.but(needle="steel-1.27"),
        SHORT.but(tissue="porcine-gelatin"),
        SHORT.but(inserted_mm=62.5),
        SHORT.but(segments=(Segment(duration_s=0.3, turn_deg=-30),)),
        SHORT.but(discretisation={"elements": 8, "arrangement": "siblings"}),
        *(SHORT.but(inserted_mm=70.0 + depth, tissue="chicken") for depth in range(20)),
    ]


@pytest.fixture(scope="module")
def alone():
    return [simulate([p.setup()], p.schedule())[0] for p in insertions()]


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_each_is_as_if_it_were_alone_at_any_number_of_threads(alone, threads):
    together = simulate_each(insertions(), threads=threads)
    assert len(together) == len(alone)
    for own, one in zip(together, alone, strict=True):
        np.testing.assert_array_equal(own.outputs, one.outputs, strict=True)
        np.testing.assert_array_equal(own.time_s, one.time_s)


def test_results_are_in_the_order_of_the_protocols():
    there, back = insertions(), insertions()[::-1]
    for one, other in zip(simulate_each(there), simulate_each(back)[::-1], strict=True):
        np.testing.assert_array_equal(one.outputs, other.outputs)


def test_no_protocol_is_no_run():
    assert simulate_each([]) == []


def test_one_that_makes_no_model_is_its_error_and_stops_no_other(alone):
    thin = SHORT.but(needle={**SHORT.needle.model_dump(), "diameter_mm": 1e-3})
    found = simulate_each([SHORT, thin, SHORT], threads=1)
    assert isinstance(found[1], InvalidValue)
    assert "inertia" in str(found[1])
    for place in (0, 2):
        np.testing.assert_array_equal(found[place].outputs, alone[0].outputs)


def test_one_that_fails_on_the_way_is_its_error_and_stops_no_other(alone, monkeypatch):
    def simulate_but(setups, inputs):
        runs = simulate(setups, inputs)
        if any(setup.inserted_mm == 75.0 for setup in setups):
            raise SimulationFailed("expected finite outputs")
        return runs

    monkeypatch.setattr(batch, "simulate", simulate_but)
    found = simulate_each(insertions(), threads=2)
    assert [place for place, run in enumerate(found) if isinstance(run, SimulationFailed)] == [11]
    for place, one in enumerate(alone):
        if place != 11:
            np.testing.assert_array_equal(found[place].outputs, one.outputs)


def test_protocols_of_one_size_share_batches(monkeypatch):
    sizes = []

    def counted(setups, inputs):
        sizes.append(len(setups))
        return simulate(setups, inputs)

    monkeypatch.setattr(batch, "simulate", counted)
    simulate_each([SHORT.but(inserted_mm=60.0 + i) for i in range(20)], threads=1)
    assert sizes == [8, 8, 4]


def test_a_mistake_in_the_program_is_raised():
    with pytest.raises(AttributeError):
        simulate_each(["fig5-10cm"])
