"""The diagnosis on logs of an independent rig, and the parts that it rests on.

The rig is `reference_rig`: finite volumes, another time stepper, no MuJoCo.
"""

import json

import numpy as np
import pandas as pd
import pytest
from diagnosis.base_motion import without_base_noise
from diagnosis.bridging import bridged
from diagnosis.coordinates import coordinates_of, starts
from diagnosis.diagnose import diagnose
from diagnosis.evidence import Evidence
from diagnosis.fit import fit_effects
from diagnosis.noise import white_noise
from diagnosis.nuisance import nuisance_of
from diagnosis.rig_log import read_rig_log
from diagnosis.rig_model import RigModel
from diagnosis.verdict import Outcome
from diagnosis.whiteness import floor_of
from reference_log import BETA, make_log

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.report import FORMAT, as_json, write_report
from scripts.main import main
from sim.recording.rerun_table import entries

VOCABULARY = {
    "coulomb_friction": "interface",
    "stiction": "interface",
    "speed_dependent_friction": "interface",
    "shear_thinning": "interface",
    "tissue_viscoelasticity": "tissue",
    "layered_tissue": "tissue",
    "entry_friction": "interface",
    "sheath_friction": "drive",
    "load_dependent_friction": "needle",
    "chuck_backlash": "drive",
    "base_compliance": "drive",
    "tip_drag": "needle",
    "needle_curvature": "needle",
    "stiffness_error": "parameters",
    "damping_error": "parameters",
    "tip_angle_bias": "sensor",
    "tip_angle_scale": "sensor",
    "tip_sensor_delay": "sensor",
    "torque_bias": "sensor",
}


def test_the_library_is_the_vocabulary():
    assert {name: effect.place.value for name, effect in LIBRARY.items()} == VOCABULARY
    assert {p.value for p in Place} == set(VOCABULARY.values())


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effects_parameters_survive_the_coordinates_of_the_fit(name):
    coordinates = coordinates_of([name])
    low, high = coordinates.bounds()
    for start in starts(LIBRARY[name]):
        assert np.all((low <= start) & (start <= high))
        rig = coordinates.rig(start)
        assert rig != RigModel()


def test_white_noise_is_measured_under_a_slow_signal():
    rng = np.random.default_rng(1)
    time = np.linspace(0, 20, 4000)
    values = 30 * np.sin(time) + rng.normal(0, 0.3, time.size)
    assert white_noise([values]) == pytest.approx(0.3, rel=0.05)


def test_white_residuals_are_at_the_floor_and_slow_ones_are_not():
    rng = np.random.default_rng(2)
    white = rng.normal(size=8000)
    assert floor_of([white]).reached
    slow = white + 0.25 * np.sin(np.linspace(0, 30, 8000))
    assert np.sqrt(np.mean(slow**2)) < 1.04  # nearly as small as noise, but not as white
    assert not floor_of([slow]).reached


def test_the_floor_allows_for_chance_where_samples_are_few():
    # Noise as its own first differences tell it: 1.03 alone would turn down one in fourteen.
    white = np.random.default_rng(3).normal(size=(400, 600))
    told = np.sqrt(0.5 * np.mean(np.diff(white, axis=1) ** 2, axis=1))
    floors = [floor_of([row / sigma]) for row, sigma in zip(white, told, strict=True)]
    assert np.std([floor.gap for floor in floors]) == pytest.approx(0.5 / np.sqrt(600), rel=0.15)
    assert sum(floor.gap > 1.03 for floor in floors) > 10
    assert sum(not floor.reached for floor in floors) <= 1
    assert floor_of([np.zeros(20_000)]).gap_limit == 1.03


@pytest.fixture(scope="module")
def dry(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dry") / "log"
    return read_rig_log(make_log(folder, {"coulomb_friction": {"level": 0.0015}}))


@pytest.fixture(scope="module")
def dry_diagnosis(dry):
    return diagnose(dry)


def test_dry_friction_is_found_where_others_would_see_damping(dry_diagnosis):
    report = as_json(dry_diagnosis)
    assert report["verdict"] == "explained"
    assert report["effects"] == ["coulomb_friction"]
    level = report["parameters"]["coulomb_friction"]["level"]
    assert level["value"] == pytest.approx(0.0015, rel=0.03)
    assert level["unit"] == "N mm / mm"
    assert report["where"]["place"] == "interface"
    assert report["gap"]["before"] > 3
    assert report["gap"]["after"] < 1.05
    assert report["gap"]["shrink_low"] < report["gap"]["shrink"] < report["gap"]["shrink_high"]


def test_probabilities_are_of_everything_and_add_up(dry_diagnosis):
    ranking = as_json(dry_diagnosis)["ranking"]
    assert {r["effect"] for r in ranking} == {*VOCABULARY, "none", "unknown"}
    assert sum(r["probability"] for r in ranking) == pytest.approx(1.0)
    assert ranking[0]["effect"] == "coulomb_friction"


def test_a_weak_second_effect_is_found_though_the_first_alone_is_at_the_floor(tmp_path):
    folder = make_log(
        tmp_path / "log", {"tip_angle_bias": {"bias": 2.5}, "tip_drag": {"damping": 0.025}}
    )
    log = read_rig_log(folder)
    found = diagnose(log)
    assert set(found.verdict.effects) == {"tip_angle_bias", "tip_drag"}
    driven = without_base_noise(bridged(log))
    evidence = Evidence(log=driven, noise=found.noise, nuisance=nuisance_of(driven))
    alone = fit_effects(evidence, ("tip_angle_bias",))
    assert floor_of(alone.by_trial).reached


def test_without_torque_a_damping_that_is_off_is_undecided_against_stiffness(tmp_path):
    """The tip feels only their ratio: each alone is within a rig's scatter, the ratio is not."""
    folder = make_log(tmp_path / "log", {}, damping=0.96 * BETA, seed=5)
    for path in folder.glob("trial_*.csv"):
        pd.read_csv(path).drop(columns="base_torque_n_mm").to_csv(path, index=False)
    found = diagnose(read_rig_log(folder))
    assert found.verdict.outcome is Outcome.UNDECIDED
    assert set(found.verdict.confusable) == {("damping_error",), ("stiffness_error",)}
    assert found.next_experiment.startswith("no run that this rig can do")


def test_the_report_is_strict_json_with_predictions_beside_it(dry_diagnosis, tmp_path):
    paths = write_report(dry_diagnosis, tmp_path / "out")
    report = json.loads(paths[0].read_text(), parse_constant=pytest.fail)
    assert report["format"] == FORMAT
    page = (tmp_path / "out" / "report.html").read_text()
    assert "explained: coulomb_friction brings the gap" in page
    assert "://" not in page  # opens without a network
    assert page.count("data:image/png;base64,") == 3
    found = {e.entity for e in entries(tmp_path / "out" / "gap.rrd")}
    assert {"/trial_1/tip_angle_deg/measured", "/trial_3/residual/base_torque_n_mm/explained"} <= found
    table = pd.read_csv(tmp_path / "out" / "predictions" / "trial_01.csv")
    assert {"time_s", "tip_angle_deg_nominal", "tip_angle_deg_explained"} <= set(table.columns)


def test_a_rig_with_nothing_unmodelled_gives_no_alarm(tmp_path, capsys):
    folder = make_log(tmp_path / "log", {}, seed=3)
    assert main(["diagnose", str(folder), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["verdict"] == "none"
    assert report["effects"] == []


def test_a_log_that_cannot_be_used_exits_2(tmp_path, capsys):
    assert main(["diagnose", str(tmp_path / "nowhere")]) == 2
    assert "rig.yaml" in capsys.readouterr().err
