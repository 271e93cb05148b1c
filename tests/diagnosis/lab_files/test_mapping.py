"""mapping.yaml: what is refused, and that all of it is named at once."""

import pytest
import yaml
from lab_files import RIG, mapping_of

from diagnosis.lab_files.mapping import ColumnSource, as_rig, guesses, read_mapping
from diagnosis.lab_files.units import MeasuredQuantity
from models.errors import InvalidValue


def read(tmp_path, accept_guesses=False, **changes):
    path = tmp_path / "mapping.yaml"
    path.write_text(yaml.safe_dump(mapping_of(["run.csv"], **changes)))
    return read_mapping(path, accept_guesses=accept_guesses)


def refusal(tmp_path, **changes):
    with pytest.raises(InvalidValue) as caught:
        read(tmp_path, **changes)
    return str(caught.value)


def columns(**changes):
    return {**mapping_of(["run.csv"])["columns"], **changes}


def test_a_whole_mapping_is_read_and_holds_the_rig(tmp_path):
    mapping = read(tmp_path)
    assert mapping.columns["base_torque_n_mm"].scale("base_torque_n_mm") == -1000
    assert as_rig(mapping)["needle"] == RIG["needle"]
    assert guesses(mapping) == []


def test_guesses_are_refused_until_they_are_confirmed_or_accepted(tmp_path):
    torque = {"column": "torque (N m)", "unit": "N m", "guess": True}
    changed = columns(base_torque_n_mm=torque)
    message = refusal(tmp_path, columns=changed)
    assert "columns.base_torque_n_mm" in message
    assert "columns.tip_angle_deg" not in message
    assert read(tmp_path, accept_guesses=True, columns=changed)


def test_all_that_is_blank_is_named_at_once_and_never_accepted(tmp_path):
    changes = {
        "columns": columns(base_angle_deg={"column": "motor"}, tip_angle_deg={"column": None}),
        "constants": {"speed_mm_s": None},
        "needle": {"diameter_mm": None, "shear_modulus_gpa": 27.2},
        "accept_guesses": True,
    }
    message = refusal(tmp_path, **changes)
    for place in (
        "columns.base_angle_deg: state 'unit'",
        "columns.tip_angle_deg.column",
        "constants.speed_mm_s (trial_00.csv)",
        "needle.diameter_mm",
        "needle.density_g_cm3",
    ):
        assert place in message
    assert "tissue" not in message


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"columns": columns(angle={"column": "a", "unit": "deg"})}, "columns.angle"),
        (
            {"columns": columns(base_angle_deg={"column": "a", "unit": "in"})},
            "'in' is not known as angle",
        ),
        (
            {"columns": columns(base_angle_deg={"column": "a", "unit": "rad", "factor": 2.0})},
            "take 'factor' out",
        ),
        ({"columns": columns(base_angle_deg={"column": "a", "factor": 0.0})}, "other than 0"),
        (
            {
                "columns": columns(
                    tip_angle_deg={"column": "a", "unit": "rpm", "derive": "differentiate"}
                )
            },
            "columns.tip_angle_deg.derive",
        ),
        (
            {"constants": {"speed_mm_s": 0, "inserted_mm": 1}},
            "constants.inserted_mm: is under 'columns'",
        ),
        ({"times": []}, "sample_hz"),
        ({"times": [{"column": "t", "unit": "fortnight"}]}, "'fortnight'"),
        ({"trials": [{"file": "../a.csv", "lab_files": ["run.csv"]}]}, "trials.../a.csv"),
        ({"columns": {"base_angle_deg": {"column": "a", "unit": "deg"}}}, "base_torque_n_mm or tip"),
        ({"resample_hz": -1}, "resample_hz"),
        ({"colums": {}}, "columns"),
    ],
)
def test_what_cannot_be_is_named(tmp_path, changes, named):
    assert named in refusal(tmp_path, **changes)


def test_a_factor_makes_any_unit_good(tmp_path):
    linear = {"column": "disp (in)", "unit": "in", "factor": 30.0}
    mapping = read(tmp_path, columns=columns(base_angle_deg=linear))
    assert mapping.columns["base_angle_deg"].scale("base_angle_deg") == 30


def test_a_trial_may_have_a_constant_of_its_own(tmp_path):
    trials = [{"file": "a.csv", "lab_files": ["run.csv"], "constants": {"speed_mm_s": 2.0}}]
    mapping = read(tmp_path, trials=trials)
    assert mapping.constant(mapping.trials[0], "speed_mm_s") == 2
    assert mapping.constant(mapping.trials[0], "free_mm") is None


def test_what_is_integrated_is_a_rate():
    assert (
        ColumnSource(column="w", derive="integrate").quantity("base_angle_deg")
        == MeasuredQuantity.ANGULAR_RATE
    )
    assert (
        ColumnSource(column="z", derive="differentiate").quantity("speed_mm_s")
        == MeasuredQuantity.LENGTH
    )
    assert ColumnSource(column="z", derive="differentiate").quantity("inserted_mm") is None


@pytest.mark.parametrize("text", ["a: [", "- 1", ""])
def test_what_is_no_mapping_is_refused_by_its_name(tmp_path, text):
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    with pytest.raises(InvalidValue, match=r"mine\.yaml"):
        read_mapping(path, accept_guesses=False)
