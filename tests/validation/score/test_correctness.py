"""What is right, and what is wrong with confidence."""

import pytest

from validation.score.correctness import correctness

SCALE = {
    "verdict": "explained",
    "effects": ["torque_scale"],
    "parameters": {"torque_scale": {"scale": 1.1}},
    "kind": "wrong_constant",
    "acceptable": [["damping_error", "stiffness_error"]],
}
NOTHING = {"verdict": "none", "effects": [], "parameters": {}, "kind": "rough_none"}
FLIPPED = {
    "verdict": "unknown",
    "effects": [],
    "parameters": {},
    "kind": "wrong_outside",
    "refusal": ["tip_angle_deg", "trial_02.csv"],
}
SEVERAL = ["stiffness_error", "damping_error"]


def report(verdict, *effects, confusable=(), why=""):
    return {"verdict": verdict, "effects": [*effects], "confusable": [*confusable], "why": why}


@pytest.mark.parametrize(
    ("answer", "said", "exact", "wrong"),
    [
        (SCALE, report("explained", "torque_scale"), True, False),
        (SCALE, report("explained", "torque_scale", confusable=[SEVERAL]), True, False),
        (SCALE, report("undecided", confusable=[["torque_scale"], SEVERAL]), True, False),
        (SCALE, report("undecided", confusable=[SEVERAL]), True, False),
        (SCALE, report("undecided", confusable=[["tip_drag"]]), False, False),
        (SCALE, report("explained", *SEVERAL), False, True),
        (SCALE, report("explained", *SEVERAL, confusable=[["torque_scale"]]), False, False),
        (SCALE, report("explained", "tip_drag", confusable=[["torque_scale"]]), False, True),
        (SCALE, report("none"), False, True),
        (SCALE, report("unknown"), False, False),
        (SCALE, report("refused", why="no such file"), False, False),
        (NOTHING, report("none"), True, False),
        (NOTHING, report("explained", "torque_bias"), False, True),
        (NOTHING, report("undecided", confusable=[["none"], ["torque_bias"]]), True, False),
        (FLIPPED, report("unknown"), True, False),
        (FLIPPED, report("refused", why="trial_02.csv: tip_angle_deg: sign"), True, False),
        (FLIPPED, report("refused", why="trial_01.csv: tip_angle_deg: sign"), False, False),
        (FLIPPED, report("explained", "tip_drag"), False, True),
        (FLIPPED, report("none"), False, True),
    ],
)
def test_a_report_is_exact_open_or_confidently_wrong(answer, said, exact, wrong):
    found = correctness(answer, said)
    assert (found.exact, found.confidently_wrong) == (exact, wrong)


@pytest.mark.parametrize(("kind", "exact"), [("single", False), ("rough_single", True)])
def test_undecided_is_exact_where_a_rough_recording_may_hide_the_difference(kind, exact):
    answer = {**SCALE, "kind": kind, "effects": ["stiction"], "acceptable": []}
    said = report("undecided", confusable=[["stiction"], ["coulomb_friction"]])
    assert correctness(answer, said).exact is exact


@pytest.mark.parametrize(
    ("effect", "confusable", "wrong"),
    [
        ("coulomb_friction", [], False),
        ("speed_dependent_friction", [], True),
        ("speed_dependent_friction", [["coulomb_friction"]], False),
    ],
)
def test_one_of_two_laws_that_coincide_is_wrong_unless_the_other_is_told(effect, confusable, wrong):
    answer = {
        "verdict": "explained",
        "effects": ["coulomb_friction"],
        "parameters": {},
        "details": {"trials": [{"sliding": False}]},
    }
    found = correctness(answer, report("explained", effect, confusable=confusable))
    assert found.undecidable
    assert found.confidently_wrong is wrong


@pytest.mark.parametrize(("scale", "wrong"), [(1.02, False), (1.4, True)])
def test_small_errors_of_stiffness_and_damping_may_be_left_out(scale, wrong):
    answer = {
        "verdict": "explained",
        "effects": ["tip_drag", "stiffness_error"],
        "parameters": {"stiffness_error": {"scale": scale}},
    }
    assert correctness(answer, report("explained", "tip_drag")).confidently_wrong is wrong
