"""Sets of logs: reproducible, without hints at their ground truth, never overwritten."""

import hashlib
import json

import pytest

from validation.logs.make import make_logs
from validation.logs.roughness.recording import ROUGHNESSES
from validation.logs.schedule import ALL_KINDS, KINDS
from validation.logs.strengths.families import UNMODELLED_FAMILIES
from validation.rig.modelled import MODELLED, WRONG_CONSTANTS


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob("*.*"))}


@pytest.mark.parametrize("workers", [1, 2])
def test_a_log_depends_on_seed_and_number_alone(made, answers, tmp_path, workers):
    again, kinds = tmp_path / "again", ["none", "single", "off_nominal"]
    make_logs(again, seed=3, count=2, short=True, kinds=kinds, workers=workers)
    assert contents(again / "logs").items() < contents(made / "logs").items()
    fewer = json.loads((again / "answers" / "answers.json").read_text())
    assert fewer.items() < answers.items()


def test_the_bytes_of_a_log_stay_as_they_are(made):
    """Of this seed as of the first version: sets that were scored once can be made again."""
    log = sorted((made / "logs" / "case_003").iterdir())
    read = hashlib.sha256(b"".join(path.read_bytes() for path in log))
    assert read.hexdigest().startswith("26279228e67eef82")


@pytest.mark.parametrize("kind", ["rough_none", "rough_single", "wrong_constant", "wrong_outside"])
def test_kinds_that_are_asked_for_are_made_with_their_answers(tmp_path, kind):
    folder = tmp_path / "set"
    make_logs(folder, seed=12, count=1, short=True, kinds=[kind], workers=1)
    (answer,) = json.loads((folder / "answers" / "answers.json").read_text()).values()
    assert answer["kind"] == kind
    assert ("roughness" in answer) == kind.startswith("rough")
    assert ("outside" in answer) == (kind == "wrong_outside")
    assert (answer["verdict"] == "none") == (kind == "rough_none")
    assert {*answer["effects"]} <= {*answer["parameters"]}
    for text in contents(folder / "logs").values():
        assert not any(name in text.decode() for name in (*WRONG_CONSTANTS, *ROUGHNESSES, *ALL_KINDS))


def test_each_roughness_can_be_asked_for_alone(tmp_path):
    how = {"seed": 12, "short": True, "kinds": ["rough_none"], "workers": 1}
    make_logs(tmp_path / "set", count=2, roughness=["outliers", "torque_drift"], **how)
    answers = json.loads((tmp_path / "set" / "answers" / "answers.json").read_text())
    assert [[*answer["roughness"]] for answer in answers.values()] == [["outliers"], ["torque_drift"]]


def test_all_kinds_can_be_asked_for_at_once(tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr("validation.logs.make._make_one", lambda job: seen.append(job[3]) or ("a", {}))
    make_logs(tmp_path / "set", seed=12, count=1, kinds=["all"], workers=1)
    assert seen == [ALL_KINDS]
    make_logs(tmp_path / "default", seed=12, count=1, workers=1)
    assert seen[1:] == [KINDS]


def test_logs_do_not_tell_their_ground_truth(made, answers):
    cases = sorted(path.name for path in (made / "logs").iterdir())
    assert cases == sorted(answers)
    for path, text in contents(made / "logs").items():
        assert path.name == "rig.yaml" or path.suffix == ".csv"
        assert not any(name in text.decode() for name in (*MODELLED, *UNMODELLED_FAMILIES, *KINDS))


def test_the_ground_truth_is_of_the_kinds_and_signatures_asked_for(answers):
    assert {answer["kind"] for answer in answers.values()} <= {"none", "single", "off_nominal"}
    for answer in answers.values():
        errors = {"stiffness_error", "damping_error"} if answer["kind"] == "off_nominal" else set()
        assert set(answer["parameters"]) - errors == set(answer["effects"])
        assert answer["verdict"] == ("none" if answer["kind"] == "none" else "explained")
        assert all(1 <= value <= 20 for value in answer["signature"].values())


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ({"count": 1, "kinds": ["double"]}, "kinds: expected some of all, none, .*found 'double'"),
        ({"count": 1, "effects": ["magnetism"]}, "effects: expected some of .*found 'magnetism'"),
        ({"count": 1, "roughness": ["rust"]}, "roughness: expected some of coloured.*found 'rust'"),
        ({"count": -3}, "count: expected at least 1 log, found -3"),
        ({"count": 1, "signature": (2.0, 1.0)}, "signature: expected 0 < LOW < HIGH, found"),
    ],
)
def test_what_cannot_be_made_is_named_before_anything_is_written(tmp_path, how, message):
    with pytest.raises(ValueError, match=message):
        make_logs(tmp_path / "new", seed=3, **how)
    assert not (tmp_path / "new").exists()


def test_a_folder_is_never_overwritten(made):
    with pytest.raises(FileExistsError):
        make_logs(made, seed=3, count=1)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"count": -3}, "count: expected at least 1 log"),
        ({"count": 0}, "count: expected at least 1"),
        ({"count": 10**9}, "count: expected at most 100000"),
        ({"seed": -1}, "seed: expected 0"),
        ({"seed": 2**64}, "seed: expected 0"),
        ({"signature": (1.0, float("inf"))}, "signature"),
        ({"signature": (float("nan"), 2.0)}, "signature"),
    ],
)
def test_what_cannot_be_made_is_refused_before_a_folder_is(tmp_path, changes, said):
    with pytest.raises(ValueError, match=said):
        make_logs(tmp_path / "set", **({"seed": 1, "count": 1} | changes))
    assert not (tmp_path / "set").exists()
