"""The paper's experiments by name: they run, and show what the paper saw."""

import pytest

from models.errors import UnknownName
from sim.experiment import perform
from sim.paper_protocols import PROTOCOLS, protocol_named


@pytest.mark.parametrize("name", PROTOCOLS)
def test_every_named_protocol_runs_and_converges(name):
    made = protocol_named(name)
    assert made.name == name
    recording = perform(made)
    assert recording["unconverged_count"][-1] == 0
    assert recording["time_s"][-1] == pytest.approx(sum(s.duration_s for s in made.segments))


def test_an_unknown_protocol_is_answered_with_the_known_ones():
    with pytest.raises(UnknownName, match="fig4-10cm"):
        protocol_named("fig99")


def test_dry_friction_holds_the_tip_until_retraction_lets_it_go():
    """Section II-B3: the lag of (2) stays while nothing slides, and goes when it does."""
    recording = perform(protocol_named("fig3-simtest"))
    lag = recording["base_angle_deg"] - recording["tip_angle_deg"]
    time = recording["time_s"]
    assert lag[(time > 21) & (time < 29.9)] == pytest.approx(49.58, abs=0.05)
    assert abs(lag[-1]) < 0.1


def test_dither_frees_most_of_the_lag():
    recording = perform(protocol_named("stiction-dither"))
    lag = recording["base_angle_deg"] - recording["tip_angle_deg"]
    assert abs(lag[-1]) < 0.05 * lag[recording["time_s"] < 7].max()
