"""The records of a mapping."""

import pytest
from lab_files import RIG, mapping_of

from diagnosis.lab_files.mapping import (
    SECTIONS,
    ColumnSource,
    ImportMapping,
    TimeSource,
    as_rig,
    guesses,
)
from diagnosis.lab_files.units import MeasuredQuantity
from diagnosis.log.nominal_rig import NominalRig


def test_a_mapping_holds_the_rig():
    rig = NominalRig(**as_rig(ImportMapping(**mapping_of(["a.csv", "b.csv"]))))
    assert rig.needle.diameter_mm == RIG["needle"]["diameter_mm"]
    assert [entry.file for entry in rig.trials] == ["trial_00.csv", "trial_01.csv"]


def test_guesses_are_listed():
    content = mapping_of(["run.csv"])
    assert guesses(ImportMapping(**content)) == []
    content["times"][0]["guess"] = content["columns"]["free_mm"]["guess"] = True
    content["trials"][0]["guess"] = True
    assert guesses(ImportMapping(**content)) == [
        "trials.trial_00.csv",
        "times.t (ms)",
        "columns.free_mm",
    ]


def test_a_unit_of_time_has_its_seconds():
    assert TimeSource(column="t", unit="ms").seconds == pytest.approx(1e-3)
    assert TimeSource(column="t", factor=0.5).seconds == 0.5


def test_a_factor_makes_any_unit_good():
    linear = ColumnSource(column="disp (in)", unit="in", factor=30.0, sign=-1)
    assert linear.scale("base_angle_deg") == -30
    assert ColumnSource(column="m", unit="N m").scale("base_torque_n_mm") == 1000


def test_a_trial_may_have_a_constant_of_its_own():
    trials = [{"file": "a.csv", "lab_files": ["run.csv"], "constants": {"speed_mm_s": 2.0}}]
    mapping = ImportMapping(**mapping_of(["run.csv"], trials=trials))
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


def test_a_mapping_has_every_section_of_rig_yaml():
    assert set(SECTIONS) | {"format", "trials"} == set(NominalRig.model_fields)
    plain = as_rig(ImportMapping(**mapping_of(["run.csv"])))
    assert "inertia" not in plain
    content = as_rig(ImportMapping(**mapping_of(["run.csv"], inertia={"tip_kg_m2": 1e-6})))
    assert content == {**plain, "inertia": {"tip_kg_m2": 1e-6}}
