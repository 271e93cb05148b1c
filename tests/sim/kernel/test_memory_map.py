"""The one owner of positions: no gaps, no overlaps, and sizes that add up."""

import pytest

from sim.kernel import memory_map


@pytest.mark.parametrize(
    ("prefix", "size"),
    [("H_", "HEADER"), ("L_", "COLUMNS"), ("U_", "INPUTS"), ("O_", "OUTPUTS"), ("T_", "TORQUES")],
)
def test_every_field_of_a_block_has_a_place_of_its_own(prefix, size):
    names = [name for name in vars(memory_map) if name.startswith(prefix)]
    places = sorted(getattr(memory_map, name) for name in names)
    assert places == list(range(getattr(memory_map, size)))


def test_the_parts_of_a_state_follow_one_another():
    assert memory_map.B_OUTPUTS == 0
    assert memory_map.B_INPUTS - memory_map.B_OUTPUTS == memory_map.OUTPUTS
    assert memory_map.B_ANGLES - memory_map.B_INPUTS == memory_map.INPUTS


def test_every_output_has_a_sensor_whose_name_stands_at_its_place():
    for place, name in enumerate(memory_map.OUTPUT_SENSORS):
        assert getattr(memory_map, f"O_{name.upper()}") == place
    assert len(memory_map.OUTPUT_SENSORS) == memory_map.OUTPUTS


@pytest.mark.parametrize(("elements", "rows"), [(2, 1), (2, 3), (16, 1), (16, 3)])
def test_the_memory_of_a_model_holds_clock_two_states_torques_and_workspace(elements, rows):
    sites = 2 * elements * rows
    assert memory_map.sites_at(elements) == memory_map.B_ANGLES + 2 * (elements + 1) + elements
    state = memory_map.sites_at(elements) + memory_map.SITE * sites
    assert memory_map.block(elements, rows) == state
    torques = 3 * (elements + 1)  # tissue, other, correction of every hinge
    total = memory_map.CLOCK + 2 * state + torques + memory_map.scratch(elements, rows)
    assert memory_map.userdata(elements, rows) == total
