"""Reading rig.yaml: fields, and YAML that is more than plain values."""

import time
from itertools import pairwise

import pytest
from analytic_log import RIG, change_rig, refusal

from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.rig_yaml import read_rig
from diagnosis.log.trial import UnusableLog

FIELDS = [
    (lambda c: c.update(format="rig-log/2"), "expected 'rig-log/1', found 'rig-log/2'"),
    (
        lambda c: c["needle"].update(diameter_mm=5000),
        r"needle.diameter_mm: .*0.05 to 100, found 5000",
    ),
    (
        lambda c: c["needle"].update(shear_modulus_gpa=27200),
        r"shear_modulus_gpa: .*1000, found 27200",
    ),
    (lambda c: c["tissue"].update(damping_n_mm_s_per_mm=17.0), r"damping_n_mm_s_per_mm.*found 17"),
    (lambda c: c["sensors"].update(tip_angle_noise_deg=-1), r"tip_angle_noise_deg.*-1"),
    (lambda c: c["sensors"].update(tip_angle_noise_deg=720), r"tip_angle_noise_deg: .*0 to 90"),
    (lambda c: c["needle"].update(diameter_mm="thin"), r"diameter_mm.*'thin'"),
    (lambda c: c["needle"].update(diameter_mm=float("nan")), r"diameter_mm.*nan"),
    (lambda c: c["needle"].update(diameter_m=c["needle"].pop("diameter_mm")), r"'diameter_m'.*by 1000"),
    (
        lambda c: c["needle"].update(shear_modulus_mpa=c["needle"].pop("shear_modulus_gpa")),
        r"'shear_modulus_gpa' is missing; 'shear_modulus_mpa'.*by 0.001 and rename",
    ),
    (
        lambda c: c["sensors"].update(tip_angle_noise_rad=c["sensors"].pop("tip_angle_noise_deg")),
        r"sensors: field 'tip_angle_noise_deg'.*57.2958",
    ),
    (lambda c: c["tissue"].update(damping=c["tissue"].pop("damping_n_mm_s_per_mm")), r"'damping' looks"),
    (lambda c: c["needle"].update(colour="red"), r"needle.colour"),
    (lambda c: c.update(trials=["turns.csv"]), r"trials"),
    (
        lambda c: c["trials"].append({"file": "turns.csv"}),
        r"trials.2.file: expected each file once, found 'turns.csv' again",
    ),
    (lambda c: c["trials"].append({"file": "../turns.csv"}), r"trials.2.file.*in the folder"),
    (lambda c: c["trials"].append({"file": "/etc/hosts"}), r"trials.2.file.*in the folder"),
    (lambda c: c["trials"].append({"file": ""}), r"trials.2.file: .*letters"),
    (lambda c: c["trials"].append({"file": "."}), r"trials.2.file: .*letters"),
    (lambda c: c["trials"].append({"file": "a\nb.csv"}), r"trials.2.file: .*control characters"),
    (lambda c: c["trials"].append({"file": "x" * 201}), r"trials.2.file: .*at most 200 bytes"),
    (lambda c: c["trials"].append({"file": "a\0b.csv"}), r"control characters"),
    (
        lambda c: c["trials"].append({"file": "C:\\turns.csv"}),
        r"trials.2.file.*in the folder",
    ),
]

_ENDLESS_S = 20.0  # what is refused at once on any machine, however busy, and what would never end


@pytest.mark.parametrize(("change", "said"), FIELDS)
def test_a_wrong_field_of_rig_yaml_is_named(log, change, said):
    change_rig(log, change)
    with pytest.raises(UnusableLog, match=rf"(?s)rig\.yaml.*{said}"):
        read_rig_log(log)


SECTIONS = [
    (lambda c: c.update(format="rig-log/2"), "rig-log/1"),
    (lambda c: c["needle"].pop("diameter_mm"), "diameter_mm"),
    (lambda c: c["needle"].update(diameter_mm=-1), "diameter_mm"),
    (lambda c: c["tissue"].update(damping="high"), "damping"),
    (lambda c: c.pop("sensors"), "sensors"),
    (lambda c: c.update(trials=[]), "trials"),
]


@pytest.mark.parametrize(("change", "said"), SECTIONS)
def test_what_is_wrong_with_rig_yaml_is_named(log, change, said):
    change_rig(log, change)
    with pytest.raises(UnusableLog, match=said):
        read_rig(log / "rig.yaml")


@pytest.mark.parametrize("text", ["", "- a", "format: [", "\x00"])
def test_a_rig_yaml_that_cannot_be_read_is_refused(log, text):
    (log / "rig.yaml").write_text(text)
    with pytest.raises(UnusableLog, match=r"rig\.yaml"):
        read_rig(log / "rig.yaml")


def test_a_good_rig_yaml_is_read_as_it_stands(log):
    rig = read_rig(log / "rig.yaml")
    assert rig.needle.shear_modulus_gpa == RIG["needle"]["shear_modulus_gpa"]
    assert [entry.file for entry in rig.trials] == ["turns.csv", "slides.csv"]


YAMLS = [
    ("", "expected a mapping"),
    ("a: 1\nneedle: {x: 1}\na: 2\n", "line 3: .*not twice, found 'a'; remove"),
    ("needle: &n {diameter_mm: 1}\n", "line 1.*anchor or alias, found 'n'"),
    ("a: " + "[" * 500 + "]" * 500, "at most 10 levels"),
    ("a: !!python/name:os.system\n", "readable YAML"),
    ("x" * 1_100_000, "at most 1000000 bytes"),
]


@pytest.mark.parametrize(("text", "said"), YAMLS)
def test_yaml_that_is_more_than_plain_values_is_refused(log, text, said):
    (log / "rig.yaml").write_text(text)
    with pytest.raises(UnusableLog, match=rf"(?s)rig\.yaml.*{said}"):
        read_rig_log(log)


def test_a_yaml_bomb_is_refused_at_once(log):
    """Nine levels of nine aliases would be 9^9 values."""
    names = "abcdefghij"
    lines = [f"{two}: &{two} [{', '.join(['*' + one] * 9)}]" for one, two in pairwise(names)]
    (log / "rig.yaml").write_text("\n".join(["a: &a [x, x, x, x, x, x, x, x, x]", *lines]))
    start = time.process_time()
    assert "alias" in refusal(log)
    assert time.process_time() - start < _ENDLESS_S


def test_where_there_is_no_rig_yaml_the_way_out_is_told(log, tmp_path):
    def said(folder):
        with pytest.raises(UnusableLog) as raised:
            read_rig_log(folder)
        return str(raised.value)

    assert "turns.csv is a file: give its folder" in said(log / "turns.csv")
    assert "there is no folder" in said(tmp_path / "nowhere")
    (log / "rig.yaml").rename(log / "rig.yml")
    assert "rename rig.yml" in said(log)
    (log / "rig.yml").unlink()
    assert "needle import" in said(log)
