"""The diagnosis on rigs that it has never met: a short run of `needle blind`.

The long run, of 210 logs, is in docs/diagnosis.md. With nine of ten logs right, which is far
below what the long run measures, 32 logs have fewer than 25 right with a probability of 1.3 %.
"""

import json

import numpy as np
import pandas as pd
import pytest

from diagnosis.predict import predict
from diagnosis.rig import NominalNeedle, NominalTissue, Rig, SensorNoise, TrialEntry
from diagnosis.rig_log import Trial
from diagnosis.rig_model import RigModel
from scripts.main import main
from validation.logs.make import make_logs
from validation.rig.rig import Motion, observe
from validation.rig.rig import Rig as BlindRig
from validation.score.calibration import coverage, hidden_below, summary
from validation.score.detection import limits
from validation.score.picture import draw
from validation.score.run import diagnose_all
from validation.score.scores import read_scores

LOGS = 32
NOMINAL = Rig(
    format="rig-log/1",
    needle=NominalNeedle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45),
    tissue=NominalTissue(damping_n_mm_s_per_mm=0.0172),
    sensors=SensorNoise(tip_angle_noise_deg=0.2, base_torque_noise_n_mm=0.01, base_angle_noise_deg=0.02),
    trials=(TrialEntry(file="a"),),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("blind") / "set"
    make_logs(folder, seed=11, count=LOGS, short=True, signature=(1.5, 20.0))
    diagnose_all(folder / "logs", folder / "reports")
    return folder


@pytest.fixture(scope="module")
def scores(folder):
    return read_scores(folder)


@pytest.mark.parametrize("growing", [False, True])
@pytest.mark.parametrize(
    "effects", [{}, {"coulomb_friction": {"level": 0.0015}}], ids=["nominal", "dry"]
)
def test_the_blind_rig_is_the_needle_of_the_product(effects, growing):
    """Two simulations that share nothing agree to a tenth of the least noise of a rig.

    0.02 deg of tip and 0.001 N mm of torque: below the replay's own error at the corners of a turn
    of 90 deg in 0.6 s, and a tenth of 0.2 deg and 0.01 N mm.
    """
    time = np.arange(0, 8.0, 0.005)
    speed = 1.5 if growing else 0.0
    motion = Motion(
        dt_s=0.005,
        per_sample=2,
        base_deg=np.interp(time, [0, 0.5, 1.1, 4, 5, 8], [0, 0, 90, 90, -20, -20]),
        inserted_mm=80.0 + speed * time,
        free_mm=70.0 - speed * time,
        speed_mm_s=np.full(time.size, speed),
    )
    seen = observe(BlindRig(damping_n_mm_s_per_mm=0.0172, effects=effects), motion)
    table = pd.DataFrame(
        {
            "time_s": time,
            "base_angle_deg": motion.base_deg,
            "inserted_mm": motion.inserted_mm,
            "free_mm": motion.free_mm,
            "speed_mm_s": motion.speed_mm_s,
        }
    )
    level = effects.get("coulomb_friction", {}).get("level", 0.0)
    # Where depth grows, the blind rig's tissue resists the material that slides past.
    candidate = RigModel(kinetic=level, slip_growing=1.0)
    found = predict(NOMINAL, Trial(name="a", table=table), [candidate])[0]
    assert np.sqrt(np.mean((found["tip_angle_deg"] - seen.tip_deg) ** 2)) < 0.02
    assert np.sqrt(np.mean((found["base_torque_n_mm"] - seen.torque_n_mm) ** 2)) < 0.001
    # Negative control: 0.2 mN mm per mm of dry friction more would be seen.
    other = predict(
        NOMINAL, Trial(name="a", table=table), [RigModel(kinetic=level + 2e-4, slip_growing=1.0)]
    )[0]
    assert np.sqrt(np.mean((other["tip_angle_deg"] - seen.tip_deg) ** 2)) > 0.05


def test_most_rigs_are_told_exactly(scores):
    assert len(scores) == LOGS
    wrong = scores[~scores["exact"]][["truth", "said", "verdict"]]
    assert scores["exact"].sum() >= 28, wrong


def test_no_alarm_is_false(scores):
    none = scores[scores["kind"] == "none"]
    assert len(none) >= 2
    assert (none["verdict"] == "none").all()


def test_a_wrong_explanation_is_rarely_said_with_confidence(scores):
    wrong = (scores["verdict"] == "explained") & ~scores["exact"]
    assert wrong.sum() <= 2, scores[wrong][["truth", "said"]]


def test_dry_friction_is_not_called_by_the_name_of_what_contains_it(scores):
    dry = scores[scores["truth"] == "coulomb_friction"]
    assert len(dry) >= 2
    assert not (dry["said"] == "stiction").any()


def test_intervals_cover(scores):
    """Of some 35 intervals of 95 %, fewer than 28 cover with a probability of 0.1 %."""
    share, count = coverage(scores)
    assert count >= 20
    assert share >= 0.8


def test_the_score_sees_a_wrong_answer(folder, scores, tmp_path):
    """Negative control: with the answers shifted by one log the score falls to nothing."""
    shifted = tmp_path / "set"
    (shifted / "answers").mkdir(parents=True)
    (shifted / "reports").symlink_to(folder / "reports")
    answers = json.loads((folder / "answers" / "answers.json").read_text())
    cases, values = list(answers), list(answers.values())
    moved = dict(zip(cases, [*values[1:], values[0]], strict=True))
    (shifted / "answers" / "answers.json").write_text(json.dumps(moved))
    assert read_scores(shifted)["exact"].mean() < 0.3 < summary(scores)["exact"].mean()


@pytest.mark.parametrize(
    ("truth", "parameters", "said", "exact"),
    [
        (["stiffness_error"], {"stiffness_error": 1.4}, ["damping_error"], False),
        (["tip_drag", "stiffness_error"], {"stiffness_error": 1.02}, ["tip_drag"], True),
        (["tip_drag", "stiffness_error"], {"stiffness_error": 1.4}, ["tip_drag"], False),
        (["tip_drag"], {"stiffness_error": 1.01}, ["tip_drag", "stiffness_error"], True),
        (["tip_drag"], {}, ["tip_drag", "stiffness_error"], False),
    ],
)
def test_what_is_a_little_off_beside_an_effect_may_be_named_or_not(
    tmp_path, truth, parameters, said, exact
):
    answer = {
        "verdict": "explained",
        "effects": truth,
        "parameters": {name: {"scale": scale} for name, scale in parameters.items()},
    }
    (tmp_path / "answers").mkdir()
    (tmp_path / "reports").mkdir()
    (tmp_path / "answers" / "answers.json").write_text(json.dumps({"case_1": answer}))
    report = {"verdict": "explained", "effects": said}
    (tmp_path / "reports" / "case_1.json").write_text(json.dumps(report))
    assert bool(read_scores(tmp_path)["exact"]["case_1"]) is exact


def test_what_went_unseen_is_held_to_what_the_report_says_may_hide(tmp_path):
    parameters = {"base_compliance": {"stiffness": 80.0}}  # half as strong as 40
    answer = {"verdict": "explained", "effects": ["base_compliance"], "parameters": parameters}
    hidden = {
        "a": {"base_compliance": {"stiffness": 40.0}},
        "b": {"base_compliance": {"stiffness": 160.0}},
    }
    (tmp_path / "answers").mkdir()
    (tmp_path / "reports").mkdir()
    (tmp_path / "answers" / "answers.json").write_text(json.dumps({"a": answer, "b": answer}))
    for case, own in hidden.items():
        report = {"verdict": "none", "effects": [], "hidden": own}
        (tmp_path / "reports" / f"{case}.json").write_text(json.dumps(report))
    scores = read_scores(tmp_path)
    assert scores["over_hidden"].to_dict() == pytest.approx({"a": 0.5, "b": 2.0})
    assert hidden_below(scores) == (0.5, 2)


def test_the_score_is_printed_and_kept(folder, tmp_path, capsys):
    assert main(["blind", "score", str(folder), "--out", str(tmp_path / "score")]) == 0
    printed = capsys.readouterr().out
    assert "probabilities are off by" in printed
    assert (tmp_path / "score" / "scores.csv").read_text().count("\n") == LOGS + 1
    assert (tmp_path / "score" / "score.png").read_bytes()[:4] == b"\x89PNG"


def test_logs_and_answers_are_asked_for_by_name(tmp_path, capsys):
    assert main(["blind", "score", str(tmp_path)]) == 2
    assert "answers" in capsys.readouterr().err
    assert main(["blind", "make", "--out", str(tmp_path)]) == 2
    assert "does not exist yet" in capsys.readouterr().err
    out = str(tmp_path / "new")
    assert main(["blind", "make", "--out", out, "--effects", "magnetism"]) == 2
    assert "magnetism" in capsys.readouterr().err


def test_the_first_trials_alone_tell_less(folder):
    """A log of one trial is diagnosed too, beside the reports on whole logs."""
    case = sorted((folder / "logs").iterdir())[0].name
    single = folder.parent / "single"
    (single / "logs").mkdir(parents=True)
    (single / "logs" / case).symlink_to(folder / "logs" / case)
    (single / "answers").symlink_to(folder / "answers")
    assert main(["blind", "score", str(single), "--trials", "1"]) == 0
    report = json.loads((single / "reports_of_1" / f"{case}.json").read_text())
    whole = json.loads((folder / "reports" / f"{case}.json").read_text())
    assert report["gap"]["before"] != whole["gap"]["before"]
    assert not (single / "reports").exists()
    assert main(["blind", "score", str(single), "--trials", "0"]) == 2


def test_a_detection_limit_is_between_what_was_missed_and_what_was_named():
    rows = [
        ("a", 0.1, False),
        ("a", 0.2, True),
        ("a", 0.25, False),
        ("a", 0.3, False),
        ("a", 1.2, True),
        ("a", 2.0, True),
    ]
    rows += [
        ("b", 1.0, True),
        ("c", 0.1, False),
        ("d", 0.1, True),
        ("d", 0.2, False),
        ("a + b", 0.5, False),
    ]
    table = pd.DataFrame(rows, columns=["truth", "signature", "exact"]).assign(expected="explained")
    found = limits(table)
    assert found.loc["a", "limit"] == pytest.approx(np.sqrt(0.3 * 1.2))
    assert found.loc[["b", "c", "d"], "limit"].isna().all()
    assert list(found.index) == ["a", "b", "c", "d"]


def test_logs_without_a_known_signature_are_drawn_too(scores, tmp_path):
    """As those of a rig of the user's own, whose answers name the effect alone."""
    draw(scores.assign(signature=np.nan), tmp_path / "own.png")
    draw(scores[scores["kind"] == "none"], tmp_path / "none.png")
    assert (tmp_path / "own.png").stat().st_size > 10_000
    assert (tmp_path / "none.png").stat().st_size > 10_000
