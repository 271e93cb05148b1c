"""Rows of results: those of single runs, bit by bit."""

import numpy as np
import pytest

from sim.experiment import perform
from sim.needles.run import SimulationFailed
from studies.campaign import run_case
from studies.campaign.campaign import read_campaign
from studies.campaign.cases import cases_of
from studies.campaign.run_case import rows_of
from studies.control.closed_loop_run import perform_closed_loop


@pytest.fixture
def campaign(campaign_file):
    return read_campaign(campaign_file())


def expected(recording):
    lag = np.abs(recording["base_angle_deg"] - recording["tip_angle_deg"])
    return {
        "largest_lag_deg": lag.max(),
        "largest_lag_time_s": recording["time_s"][lag.argmax()],
        "end_lag_deg": lag[-1],
        "largest_base_torque_n_mm": np.abs(recording["base_torque_n_mm"]).max(),
        "end_tip_deg": recording["tip_angle_deg"][-1],
        "unconverged_count": int(recording["unconverged_count"][-1]),
    }


def test_an_insertion_is_summed_up_as_if_it_were_run_alone(campaign):
    for row, case in zip(rows_of(campaign, range(3)), cases_of(campaign, range(3)), strict=True):
        results = expected(perform(case.protocol))
        fixed = {"case": case.number, "status": "done", "error": None, **case.varied}
        assert row == fixed | results


def test_a_row_does_not_depend_on_the_piece_that_it_is_in(campaign):
    assert rows_of(campaign, range(6)) == rows_of(campaign, range(3)) + rows_of(campaign, range(3, 6))


def test_a_control_run_is_summed_up_as_if_it_were_run_alone(campaign_file):
    campaign = read_campaign(campaign_file(kind="control", controller="least_time"))
    (row,) = rows_of(campaign, [1])
    recording = perform_closed_loop(cases_of(campaign, [1])[0].protocol, "least_time")
    tip = recording["tip_angle_deg"]
    results = expected(recording) | {
        "end_tip_error_deg": abs(recording["wanted_tip_deg"][-1] - tip[-1]),
        "largest_estimate_error_deg": np.abs(recording["estimate_tip_deg"] - tip).max(),
    }
    assert row.items() >= results.items()


def test_a_case_that_fails_is_a_row_with_its_error(campaign_file):
    wide = {"free_mm": {"grid": [10.0, 500.0]}}
    done, failed = rows_of(read_campaign(campaign_file(vary=wide, samples=1)), [0, 1])
    assert (done["status"], failed["status"]) == ("done", "failed")
    assert "needle.length_mm" in failed["error"]
    assert "largest_lag_deg" not in failed


def test_a_step_too_large_for_the_accuracy_is_a_failed_case(campaign_file, campaign):
    base = campaign.base.but(accuracy_deg=1e-9).model_dump(mode="json")
    (row,) = rows_of(read_campaign(campaign_file(base=base)), [0])
    assert row["status"] == "failed"
    assert "discretisation.step_s" in row["error"]


def test_a_simulation_that_fails_is_told_in_its_row_alone(campaign, monkeypatch):
    def each(protocols, threads):
        runs = run_with_batch(protocols, threads=threads)
        return [runs[0], SimulationFailed("expected finite outputs"), *runs[2:]]

    run_with_batch = run_case.simulate_each
    whole = rows_of(campaign, range(3))
    monkeypatch.setattr(run_case, "simulate_each", each)
    rows = rows_of(campaign, range(3))
    assert rows[1]["error"] == "expected finite outputs"
    assert [rows[0], rows[2]] == [whole[0], whole[2]]


def test_a_diagnosis_is_its_verdict(campaign_file, tmp_path, monkeypatch):
    report = {
        "verdict": "explained",
        "effects": ["coulomb_friction", "backlash"],
        "gap": {"before": 5.0, "after": 1.1},
        "ranking": [{"effect": "x", "probability": 0.75}],
    }
    log = tmp_path / "log"
    log.mkdir()
    (log / "rig.yaml").touch()
    campaign = read_campaign(
        campaign_file(kind="diagnosis", base=None, vary={}, samples=1, logs="log", limit_s=9)
    )
    (refused,) = rows_of(campaign, [0])
    assert refused["status"] == "failed"
    assert "rig.yaml" in refused["error"]
    monkeypatch.setattr(run_case, "read_rig_log", lambda folder: folder)
    monkeypatch.setattr(run_case, "diagnose", lambda log, **how: (log, how))
    monkeypatch.setattr(run_case, "as_json", lambda found: report | {"warnings": found[1]["limit_s"]})
    (row,) = rows_of(campaign, [0])
    assert row["log"] == str(log.resolve())
    assert (row["verdict"], row["effects"]) == ("explained", "coulomb_friction + backlash")
    assert (row["gap_before"], row["gap_after"], row["probability"]) == (5.0, 1.1, 0.75)


def test_a_mistake_in_the_program_is_raised(campaign, monkeypatch):
    monkeypatch.setattr(run_case, "insertion_results", lambda run, protocol: 1 / len(()))
    assert rows_of(campaign, [0])[0]["status"] == "failed"  # arithmetic may be the case's
    monkeypatch.setattr(run_case, "insertion_results", lambda run, protocol: run.no_such_thing)
    with pytest.raises(AttributeError):
        rows_of(campaign, [0])
