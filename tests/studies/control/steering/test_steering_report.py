"""What control.json says of steering."""

import json

from studies.control.steering.steered_insertions import STEERED
from studies.control.steering.steering_report import steering_json


def test_both_orders_of_half_turns_are_there_with_their_names(small_steering):
    content = steering_json(small_steering)
    assert set(content["steered_mm"]) == {"to_and_fro", "winding"}
    for heights in content["steered_mm"].values():
        assert tuple(heights) == STEERED[:2]  # a small study: its baselines only
        assert max(heights.values()) < 1e-9
    assert content["steered_published_mm"] == {"base_only": 12.0, "feedforward": 4.0}


def test_what_does_not_happen_is_null_and_the_seeds_are_counted(small_steering):
    content = steering_json(small_steering)
    json.dumps(content, allow_nan=False)
    assert content["planar_mm"]["10 mm/s"]["its own simulation"] is None
    imaged = content["planar"]["10 mm/s"]["its own simulation"]
    assert imaged["converged_mm"] == {"median": None, "least": None, "largest": None}
    assert (imaged["never"], imaged["seeds"]) == (2, 2)


def test_errors_of_the_roll_and_spun_curvatures_are_there_in_numbers(small_steering):
    content = steering_json(small_steering)
    assert content["fused"]["plant"]["base alone"]["rms_deg"]["median"] == 2.0
    (spun,) = content["duty_cycle"]
    assert (spun["law_share"], spun["share"], spun["direction_deg"]) == (0.25, 0.01, None)
