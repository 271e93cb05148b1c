"""Protocols: schedules from segments, YAML files, and what is refused."""

import numpy as np
import pytest

from models.errors import InvalidValue
from models.needle import NITINOL
from sim.protocol import Protocol, read_protocol


def protocol(**changes):
    good = {
        "name": "test",
        "tissue": "viscous-plastisol",
        "free_mm": 50,
        "inserted_mm": 100,
        "through": True,
        "segments": [{"duration_s": 1, "turn_deg": 90}],
    }
    return Protocol(**(good | changes))


def test_segments_follow_one_another():
    schedule = protocol(
        segments=[
            {"duration_s": 2, "turn_deg": 90},
            {"duration_s": 1},
            {"duration_s": 1, "turn_deg": -30, "advance_mm": -5},
        ]
    ).schedule()
    assert np.interp([1, 2, 3, 4], schedule.time_s, schedule.drive) == pytest.approx([45, 90, 90, 60])
    assert schedule.free_mm[-1] == 55
    assert schedule.inserted_mm[-1] == 100
    assert schedule.speed_mm_s[-1] == -5


def test_a_needle_that_is_not_through_goes_deeper_by_what_it_advances():
    schedule = protocol(through=False, segments=[{"duration_s": 2, "advance_mm": 20}]).schedule()
    assert (schedule.free_mm[-1], schedule.inserted_mm[-1]) == (30, 120)


def test_dither_is_sampled_finely():
    schedule = protocol(segments=[{"duration_s": 2, "dither_deg": 10, "dither_hz": 5}]).schedule()
    assert schedule.drive.max() == pytest.approx(10, rel=0.01)
    assert np.diff(schedule.time_s).max() < 1 / 5 / 20


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"tissue": "jelly"}, "tissue"),
        ({"needle": "gold"}, "needle"),
        ({"segments": []}, "segments"),
        ({"segments": [{"duration_s": 0}]}, r"segments\.0\.duration_s"),
        ({"segments": [{"duration_s": 1, "turn": 90}]}, r"segments\.0"),
        ({"segments": [{"duration_s": 1, "advance_mm": 60}]}, r"segments\.0\.advance_mm"),
        ({"segments": [{"duration_s": 1, "dither_deg": 3}]}, r"segments\.0"),
        ({"segments": [{"duration_s": 1, "torque_n_mm": 3}]}, r"segments\.0\.torque_n_mm"),
        ({"drive": {"kind": "torque"}}, r"segments\.0\.torque_n_mm"),
        ({"free_mm": 400}, r"needle\.length_mm"),
        ({"inserted_mm": 0}, "inserted_mm"),
        ({"free_mm": float("nan")}, "free_mm"),
        ({"discretisation": {"elements": 1}}, r"discretisation\.elements"),
        ({"speed": 3}, "speed"),
        ({"name": "../up"}, "name: .*slashes"),
        ({"name": ""}, "name: "),
    ],
)
def test_what_is_wrong_is_named(changes, field):
    with pytest.raises(InvalidValue, match=field):
        protocol(**changes)


@pytest.mark.parametrize(
    "text", ["", "just words", "- a\n- list", "name: [unclosed", "name: &a [*a]", "name: x"]
)
def test_a_file_that_is_no_protocol_is_refused(tmp_path, text):
    path = tmp_path / "p.yaml"
    path.write_text(text)
    with pytest.raises(InvalidValue):
        read_protocol(path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InvalidValue, match=r"nothing\.yaml"):
        read_protocol(tmp_path / "nothing.yaml")


def written(path, modulus, density=6.45):
    path.write_text(
        "name: typo\ntissue: viscous-plastisol\nfree_mm: 50\ninserted_mm: 100\nthrough: true\n"
        "segments: [{duration_s: 1}]\n"
        f"needle: {{diameter_mm: 0.59, shear_modulus_gpa: {modulus}, density_g_cm3: {density}}}\n"
    )
    return path


def test_a_file_with_a_stiffness_in_another_unit_is_refused_with_how_to_fix_it(tmp_path):
    with pytest.raises(InvalidValue, match=r"shear_modulus_gpa: .*1000 GPa, found 27200.0; .*in GPa"):
        read_protocol(written(tmp_path / "p.yaml", 27200))
    assert read_protocol(written(tmp_path / "p.yaml", 1000)).needle.shear_modulus_gpa == 1000


def test_a_file_with_a_density_in_kg_per_m3_is_refused_with_how_to_fix_it(tmp_path):
    with pytest.raises(InvalidValue, match=r"density_g_cm3: .*30 g/cm3, found 6450.0; .*in g/cm3"):
        read_protocol(written(tmp_path / "p.yaml", 27.2, 6450))
    assert read_protocol(written(tmp_path / "p.yaml", 27.2, 22.6)).needle.density_g_cm3 == 22.6


def test_a_protocol_made_in_python_may_vary_its_stiffness_beyond_what_a_file_may_hold():
    assert protocol(needle=NITINOL.but(shear_modulus_gpa=1001)).needle.shear_modulus_gpa == 1001


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("name: ../up", r"p\.yaml: name: .*slashes"),
        ("1: 2", r"p\.yaml, line \d: expected the name of a field"),
        ("self: 2", r"p\.yaml: self: expected one of the fields"),
        ("drive: {stiffness_n_mm_per_rad: 1e300}", r"p\.yaml: drive\.stiffness_n_mm_per_rad: .*1e\+09"),
        ("accuracy_deg: 1e-300", r"p\.yaml: accuracy_deg: .*1e-18"),
        ("tissue: {name: x, name: y}", r"p\.yaml, line \d: expected each name once"),
    ],
)
def test_an_error_names_the_file_and_the_field(tmp_path, line, said):
    path = written(tmp_path / "p.yaml", 27)
    kept = [one for one in path.read_text().splitlines() if not one.startswith(line.split(":")[0] + ":")]
    path.write_text("\n".join([*kept, line]))
    with pytest.raises(InvalidValue, match=said):
        read_protocol(path)
