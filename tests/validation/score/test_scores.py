"""Reports against the ground truth: what counts as exact, and what cannot be decided."""

import json

import pytest

from models.errors import InvalidValue
from validation.score.calibration import summary, undetected_within_limit
from validation.score.scores import read_scores, reports_in


@pytest.fixture
def scored(tmp_path):
    """Scores of these answers and reports, by case; `folder` holds them."""

    def score(answers, reports, trials=None):
        (tmp_path / "answers").mkdir()
        reports_in(tmp_path, trials).mkdir()
        (tmp_path / "answers" / "answers.json").write_text(json.dumps(answers))
        for case, report in reports.items():
            (reports_in(tmp_path, trials) / f"{case}.json").write_text(json.dumps(report))
        return read_scores(tmp_path, trials)

    return score


def explained(*effects, **parameters):
    return {"verdict": "explained", "effects": [*effects], "parameters": parameters}


def test_the_score_sees_a_wrong_ground_truth(folder, scores, tmp_path):
    """Negative control: with the ground truth shifted by one log the score falls to nothing."""
    shifted = tmp_path / "set"
    (shifted / "answers").mkdir(parents=True)
    (shifted / "reports").symlink_to(folder / "reports")
    answers = json.loads((folder / "answers" / "answers.json").read_text())
    cases, values = list(answers), list(answers.values())
    moved = dict(zip(cases, [*values[1:], values[0]], strict=True))
    (shifted / "answers" / "answers.json").write_text(json.dumps(moved))
    assert read_scores(shifted)["exact"].mean() < 0.3 < summary(scores)["exact"].mean()


def test_a_row_of_as_many_effects_that_no_log_can_tell_from_the_true_ones_is_right(scored):
    """Its probability counts with that of the truth; that of fewer effects does not."""
    rows = {
        "torque_scale": 0.6,
        "damping_error + torque_scale": 0.3,
        "damping_error + stiffness_error": 0.1,
    }
    ranking = [
        {"effect": effect, "effects": effect.split(" + "), "probability": p}
        for effect, p in rows.items()
    ]
    answer = explained("damping_error", "stiffness_error")
    answer["acceptable"] = [["damping_error", "torque_scale"], ["torque_scale"]]
    table = scored({"a": answer}, {"a": {**explained("torque_scale"), "ranking": ranking}})
    assert table["probability_right"]["a"] == pytest.approx(0.4)
    assert not table["top_right"]["a"]


@pytest.mark.parametrize(
    ("true", "scale", "diagnosed", "exact"),
    [
        (["stiffness_error"], 1.4, ["damping_error"], False),
        (["tip_drag", "stiffness_error"], 1.02, ["tip_drag"], True),
        (["tip_drag", "stiffness_error"], 1.4, ["tip_drag"], False),
        (["tip_drag"], 1.01, ["tip_drag", "stiffness_error"], True),
        (["tip_drag"], None, ["tip_drag", "stiffness_error"], False),
    ],
)
def test_a_small_parameter_error_beside_an_effect_may_be_named_or_not(
    scored, true, scale, diagnosed, exact
):
    parameters = {"stiffness_error": {"scale": scale}} if scale else {}
    table = scored({"a": explained(*true, **parameters)}, {"a": explained(*diagnosed)})
    assert bool(table["exact"]["a"]) is exact


@pytest.mark.parametrize(("sliding", "trials", "exact"), [(True, None, False), (True, 1, True)])
def test_where_the_laws_coincide_undecided_is_exact(scored, sliding, trials, exact):
    """At rest axially, Coulomb and speed-dependent friction are one law; the second trial slides."""
    answer = explained("coulomb_friction") | {
        "details": {"trials": [{"sliding": False}, {"sliding": sliding}]}
    }
    confusable = [["coulomb_friction"], ["speed_dependent_friction"]]
    report = {"verdict": "undecided", "effects": [], "confusable": confusable}
    table = scored({"a": answer}, {"a": report}, trials)
    assert bool(table["exact"]["a"]) is exact
    assert bool(table["open"]["a"]) is exact
    assert table["confused"]["a"]


def test_without_torque_only_the_ratio_of_the_constants_is_decidable(scored):
    details = {"missing": "base_torque_n_mm", "trials": [{"sliding": True}]}
    table = scored({"a": explained("stiffness_error") | {"details": details}}, {"a": explained()})
    assert table["open"]["a"]


def test_undetected_effects_are_compared_with_the_reported_detection_limit(scored):
    answer = explained("base_compliance", base_compliance={"stiffness": 80.0})  # half as strong as 40
    limits = {"a": 40.0, "b": 160.0}
    reports = {
        case: {"verdict": "none", "effects": [], "hidden": {"base_compliance": {"stiffness": limit}}}
        for case, limit in limits.items()
    }
    table = scored({"a": answer, "b": answer}, reports)
    assert table["over_hidden"].to_dict() == pytest.approx({"a": 0.5, "b": 2.0})
    assert undetected_within_limit(table) == (0.5, 2)


def test_an_interval_counts_where_the_true_effects_are_named(scored):
    answer = explained("tip_drag", tip_drag={"damping": 0.5})
    interval = {"tip_drag": {"damping": {"low": 0.4, "high": 0.6}}}
    beside = {"tip_drag": {"damping": {"low": 0.51, "high": 0.6}}}
    reports = {
        "a": explained("tip_drag", **interval),
        "b": explained("tip_drag", **beside),
        "c": explained("entry_friction", **interval),
    }
    table = scored(dict.fromkeys("abc", answer), reports)
    assert list(table["intervals"]) == [1, 1, 0]
    assert list(table["inside"]) == [1, 0, 0]


@pytest.mark.parametrize(("low", "high", "inside"), [(-180.4, -179.6, 1), (-179.8, -179.4, 0)])
def test_an_angle_is_compared_with_the_nearest_turn(low, high, inside, scored):
    true = explained("needle_curvature", needle_curvature={"phase": 179.9})
    told = {"value": (low + high) / 2, "low": low, "high": high}
    report = explained("needle_curvature", needle_curvature={"phase": told})
    assert list(scored({"a": true}, {"a": report})["inside"]) == [inside]


def test_the_first_rank_is_right_if_it_is_a_true_effect(scored):
    ranking = [{"effect": "tip_drag", "probability": 0.7}, {"effect": "stiction", "probability": 0.2}]
    reports = dict.fromkeys("ab", explained("tip_drag") | {"ranking": ranking})
    table = scored({"a": explained("tip_drag"), "b": explained("stiction")}, reports)
    assert list(table["top_right"]) == [True, False]
    assert list(table["probability_right"]) == [0.7, 0.2]


@pytest.mark.parametrize(("scale", "right"), [(1.01, 0.9), (1.4, 0.2)])
def test_a_first_rank_may_name_a_small_parameter_error_or_not(scored, scale, right):
    """Both rows are right where the error is small; where it is not, the one that names it."""
    answer = explained("tip_drag", "stiffness_error", stiffness_error={"scale": scale})
    ranking = [
        {"effect": "tip_drag", "effects": ["tip_drag"], "probability": 0.7},
        {
            "effect": "stiffness_error + tip_drag",
            "effects": ["tip_drag", "stiffness_error"],
            "probability": 0.2,
        },
        {"effect": "none", "effects": [], "probability": 0.1},
    ]
    table = scored({"a": answer}, {"a": explained("tip_drag") | {"ranking": ranking}})
    assert bool(table["top_right"]["a"]) is (scale == 1.01)
    assert table["probability_right"]["a"] == pytest.approx(right)


def test_of_a_nominal_rig_the_verdict_itself_is_right(scored):
    none = {"verdict": "none", "effects": [], "parameters": {}}
    ranking = [
        {"effect": "none", "effects": [], "probability": 0.6},
        {"effect": "unknown", "effects": [], "probability": 0.4},
    ]
    table = scored({"a": none}, {"a": none | {"ranking": ranking}})
    assert table["top_right"]["a"]
    assert table["probability_right"]["a"] == 0.6


def test_reports_of_few_trials_or_within_a_limit_are_kept_apart(tmp_path):
    names = [reports_in(tmp_path, t, s).name for t in (None, 2) for s in (None, 20.0)]
    assert names == ["reports", "reports_in_20_s", "reports_of_2", "reports_of_2_in_20_s"]


def test_a_log_without_a_report_has_no_row_and_a_set_without_any_is_refused(scored, tmp_path):
    answers = {"a": explained("tip_drag"), "b": explained("tip_drag")}
    assert list(scored(answers, {"a": explained("tip_drag")}).index) == ["a"]
    (tmp_path / "reports" / "a.json").unlink()
    with pytest.raises(InvalidValue, match=r"answers\.json: expected entries named like the logs"):
        read_scores(tmp_path)
