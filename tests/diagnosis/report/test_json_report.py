"""report.json: the contract with other programs."""

import json
from dataclasses import asdict, replace

import pytest
from diagnosis_fixtures import scored
from free_forms import LAW, VOCABULARY, missing_with

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.sensing.reading_errors import ClockStart
from diagnosis.report.json_report import FORMAT, as_json
from diagnosis.residuals.lead import Lead
from diagnosis.selection.record import Decision
from studies.campaign.posterior.rig_posterior import RigPosterior

KEYS = {
    "format",
    "verdict",
    "stopped",
    "effects",
    "confusable",
    "ranking",
    "parameters",
    "covariance",
    "gap",
    "nearest",
    "where",
    "next_experiment",
    "floor",
    "fit",
    "further",
    "beside_hidden",
    "hidden",
    "cannot_tell",
    "replay_error",
    "rig",
    "noise",
    "noise_colour",
    "search",
    "sensors",
    "warnings",
}


def with_errors(assessment, **errors):
    return replace(assessment, sensors=replace(assessment.sensors, **errors))


def test_the_drift_of_each_sensor_is_there(dry):
    told = with_errors(dry.found.assessment, drift_sigma={TORQUE: 2.0, TIP: 3.5})
    sensors = as_json(replace(dry.found, assessment=told))["sensors"]
    assert (sensors["torque_drift_sigma"], sensors["tip_drift_sigma"]) == (2.0, 3.5)


def test_clocks_that_ran_before_trials_are_there(dry):
    clock = ClockStart(trial="a.csv", sensor=TIP, before_s=2.5)
    told = with_errors(dry.found.assessment, clock_starts=(clock,))
    sensors = as_json(replace(dry.found, assessment=told))["sensors"]
    assert sensors["clock_starts"] == [{"trial": "a.csv", "sensor": TIP, "before_s": 2.5}]
    assert dry.report["sensors"]["clock_starts"] == []


def test_every_key_is_there_and_no_other(dry):
    assert set(dry.report) == KEYS
    assert dry.report["format"] == FORMAT


def test_a_report_is_strict_json(dry):
    text = json.dumps(dry.report, allow_nan=False)
    assert json.loads(text, parse_constant=pytest.fail) == dry.report


def test_what_explains_the_log_is_told_with_its_value_unit_and_place(dry):
    report = dry.report
    assert report["verdict"] == "explained"
    assert report["effects"] == ["coulomb_friction"]
    level = report["parameters"]["coulomb_friction"]["level"]
    assert level["value"] == pytest.approx(0.0015, rel=0.03)
    assert level["low"] < level["value"] < level["high"]
    assert level["unit"] == "N mm / mm"
    assert report["where"]["place"] == "interface"


def test_the_covariance_is_that_of_the_intervals(dry):
    """Of a level that is known to 1 %: half the interval is 1.96 sd."""
    known, level = dry.report["covariance"], dry.report["parameters"]["coulomb_friction"]["level"]
    assert known["parameters"] == [
        "coulomb_friction.level",
        "stiffness_error.scale",
        "damping_error.scale",
    ]
    assert known["values"][0] == level["value"]
    half = 1.96 * known["matrix"][0][0] ** 0.5
    assert half == pytest.approx((level["high"] - level["low"]) / 2, rel=0.01)
    assert all(
        low < value < high for value, (low, high) in zip(known["values"], known["bounds"], strict=True)
    )
    assert (
        RigPosterior(rig=dry.report["rig"], **known).fitted["coulomb_friction.level"] == level["value"]
    )


PARTS = {"signal", "phase", "band_hz", "depth_mm", "time_s"}
SHAPE = {
    *("base_angle_deg", "since_reversal_s", "rate_deg_s", "autocorrelation", "spectrum", "leads"),
}


def test_where_the_gap_is_is_told_of_the_nominal_rig_and_after_of_what_is_left(dry):
    where = dry.report["where"]
    assert set(where) == PARTS | SHAPE | {"place", "after"}
    assert set(where["after"]) == PARTS | SHAPE
    told = dry.found.assessment
    assert where["signal"] == told.breakdown.signal
    assert where["after"]["signal"] == told.breakdown_after.signal
    for part in ("base_angle_deg", "since_reversal_s", "rate_deg_s"):
        assert max(gap for _, gap in where[part]) > 2
        assert max(gap for _, gap in where["after"][part]) < 1.7


def test_the_memory_of_the_residual_is_told_before_and_after(dry):
    before = dry.report["where"]["autocorrelation"]["base_torque_n_mm"]
    after = dry.report["where"]["after"]["autocorrelation"]["base_torque_n_mm"]
    assert before["lag_one_correlation"] > 0.5
    # Within its band in 95 of 100, beyond twice that in 1 of 10 000.
    assert abs(after["lag_one_correlation"]) < 2 * after["white_limit"]
    assert after["integral_s"] == pytest.approx(0.01, rel=1.0)


def test_which_signal_leads_is_told_where_it_is_certain_alone(dry):
    certain = Lead(
        signal="tip_angle_deg", by_s=0.1, low_s=0.05, high_s=0.2, correlation=0.9, chance_limit=0.2
    )
    for leads, told in ((certain, asdict(certain)), (replace(certain, signal=""), None), (None, None)):
        shape = replace(dry.found.assessment.shape, leads=leads)
        found = replace(dry.found, assessment=replace(dry.found.assessment, shape=shape))
        assert as_json(found)["where"]["leads"] == told


def test_the_gap_is_told_with_its_reduction(dry):
    gap = dry.report["gap"]
    assert gap["before"] > 3
    assert gap["after"] < 1.05
    assert gap["shrink_low"] < gap["shrink"] < gap["shrink_high"]


def test_probabilities_are_of_everything_and_add_up(dry):
    ranking = dry.report["ranking"]
    assert {r["effect"] for r in ranking} >= {*LIBRARY, "none", "unknown"}
    sets = [r for r in ranking if r["effect"] not in {*LIBRARY, "none", "unknown"}]
    assert all(r["effect"] == " + ".join(sorted(r["effects"])) for r in sets)
    assert sum(r["probability"] for r in ranking) == pytest.approx(1.0)
    assert ranking[0]["effect"] == "coulomb_friction"


def test_a_set_of_effects_is_a_row_of_its_own(dry):
    ranking = ((("tip_drag", "torque_bias"), 0.9), (("none",), 0.1))
    found = replace(dry.found, verdict=replace(dry.found.verdict, ranking=ranking))
    assert as_json(found)["ranking"] == [
        {
            "effect": "tip_drag + torque_bias",
            "effects": ["tip_drag", "torque_bias"],
            "probability": 0.9,
        },
        {"effect": "none", "effects": [], "probability": 0.1},
    ]


def test_how_the_fit_ended_is_told(dry):
    fit = dry.report["fit"]
    assert set(fit) == {"status", "message", "at_bound", "presliding_deg"}
    assert fit["status"] == "converged: relative offset"
    assert fit["message"].startswith("converged after ")
    assert fit["at_bound"] == []
    assert fit["presliding_deg"] == 0.1


def test_every_decision_of_the_search_is_told(dry):
    search = dry.report["search"]
    assert len(search) == len(dry.found.record)
    assert {e["decision"] for e in search} <= {d.value for d in Decision}
    keys = {"stage", "effects", "decision", "reason", "score", "gap"}
    assert all(set(entry) == keys for entry in search)
    finalist = {"stage": "finalists", "effects": ["coulomb_friction"], "decision": "made"}
    assert any(finalist.items() <= entry.items() for entry in search)


def test_both_floors_are_told(dry):
    floor = dry.report["floor"]
    assert floor["fitted"]["gap"] <= floor["fitted"]["gap_limit"]
    assert floor["unseen"]["slow"] <= floor["unseen"]["slow_limit"]
    assert floor["surprise"] == dry.found.verdict.best.shift


def test_what_was_not_checked_on_held_out_trials_has_no_floor_there(dry):
    best = scored(["tip_drag"], 1.0, held_out=None, held_out_floor=None)
    found = replace(dry.found, verdict=replace(dry.found.verdict, best=best))
    assert as_json(found)["floor"]["unseen"] is None


def test_a_rig_with_nothing_unmodelled_gives_no_alarm(nothing):
    assert nothing.report["verdict"] == "none"
    assert nothing.report["effects"] == []
    assert nothing.report["where"]["place"] == ""
    assert nothing.report["warnings"] == []
    assert set(nothing.report) == KEYS


def test_what_is_missing_is_told_where_it_was_looked_for_alone(dry):
    assert dry.found.missing is None
    report = as_json(replace(dry.found, missing=missing_with()))
    assert set(report) == KEYS | {"missing"}
    missing = json.loads(json.dumps(report, allow_nan=False), parse_constant=pytest.fail)["missing"]
    assert set(missing) == {
        *("place", "depends_on", "law", "laws_beside", "looks_like", "closed", "determined_share"),
    }
    assert set(missing["place"]) == {place.value for place in Place}
    assert {one["variable"] for one in missing["depends_on"]} <= VOCABULARY
    # What could not be simulated on an unseen trial has no gap: JSON knows no infinity.
    assert [one["gap_after"] for one in missing["depends_on"]] == [1.03, 2.5, None]
    law = missing["law"]
    assert {"place", "variable", "unit", "x", "y", "low", "high"} <= set(law)
    assert (law["place"], law["variable"], law["unit"]) == ("interface", "rate", "N mm / mm")
    for column in ("x", "y", "low", "high"):
        assert law[column] == list(getattr(LAW, column))


def test_laws_beside_the_first_are_told_as_it_is(dry):
    other = replace(LAW, variable="time")
    (told,) = as_json(replace(dry.found, missing=missing_with(beside=(other,))))["missing"][
        "laws_beside"
    ]
    assert told == as_json(replace(dry.found, missing=missing_with(other)))["missing"]["law"]


def test_where_no_law_helps_there_is_none(dry):
    report = as_json(replace(dry.found, missing=missing_with(law=None)))
    assert report["missing"]["law"] is None
    assert report["missing"]["closed"] is False
