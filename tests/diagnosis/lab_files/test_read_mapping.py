"""mapping.yaml: what is refused, and that all of it is named at once."""

import pytest
import yaml
from lab_files import RIG, mapping_of

from diagnosis.lab_files.read_mapping import read_mapping
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


def test_a_whole_mapping_is_read(tmp_path):
    mapping = read(tmp_path)
    assert mapping.columns["base_torque_n_mm"].column == "torque (N m)"
    assert mapping.needle == RIG["needle"]


def test_numbers_may_be_written_with_an_exponent(tmp_path):
    """YAML takes 1e-05 for text, the record does not."""
    torque = {"column": "torque (N m)", "unit": "N m", "zero": "1e-05"}
    assert (
        read(tmp_path, columns=columns(base_torque_n_mm=torque)).columns["base_torque_n_mm"].zero == 1e-5
    )


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


def test_inertia_may_be_left_out_but_not_left_blank(tmp_path):
    assert read(tmp_path).inertia == {}
    assert read(tmp_path, inertia={"base_kg_m2": 2e-6}).inertia == {"base_kg_m2": 2e-6}
    assert "inertia.tip_kg_m2: state a number" in refusal(tmp_path, inertia={"tip_kg_m2": None})
    assert "inertia.base: expected one of" in refusal(tmp_path, inertia={"base": 1.0})


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"columns": columns(angle={"column": "a", "unit": "deg"})}, "columns.angle"),
        (
            {"columns": columns(base_angle_deg={"column": "a", "unit": "in"})},
            "'in' is not a known unit of angle",
        ),
        (
            {"columns": columns(base_angle_deg={"column": "a", "unit": "rad", "factor": 2.0})},
            "remove 'factor'",
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


@pytest.mark.parametrize("text", ["a: [", "- 1", ""])
def test_what_is_no_mapping_is_refused_by_its_name(tmp_path, text):
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    with pytest.raises(InvalidValue, match=r"mine\.yaml"):
        read_mapping(path, accept_guesses=False)
