"""What effects change, as a MuJoCo needle."""

from dataclasses import fields, replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.replay.rig_parameters import NOMINAL, Past, RigParameters
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump
from diagnosis.replay.sensing.sensors import driven, sensed
from sim.schedule import COLUMNS, Schedule


def setup(rig, one=None):
    """The needle of a trial of 90 mm depth."""
    schedule = (one or prepared(trial(turns()))).schedule
    return rig.setup(RIG, schedule, elements=12, step_s=0.01)


def test_the_nominal_rig_is_that_of_rig_yaml():
    found = setup(NOMINAL)
    assert found.needle.shear_modulus_gpa == RIG.needle.shear_modulus_gpa
    assert found.tissue == RigParameters().tissue(RIG)
    assert found.tissue.layers[0].interface.viscous_n_mm_s_per_mm == RIG.tissue.damping_n_mm_s_per_mm
    assert (found.free_mm, found.inserted_mm) == (60.0, 90.0)
    assert found.drive.backlash_deg == 0
    assert found.drive.stiffness_n_mm_per_rad is None


SENSORS = {
    *("tip_bias_deg", "tip_scale", "tip_delay_s"),
    *("torque_bias_n_mm", "torque_scale", "torque_delay_s", "drive_friction_n_mm"),
    *("tip_clock_ratio", "torque_clock_ratio", "torque_low_pass_s", "torque_butterworth_s"),
    "torque_average_s",
}
INPUTS = {"base_scale", "inserted_offset_mm", "offset_free_share"}
NEEDS = {  # what a field shows beside only
    "static_excess_n_mm_per_mm": {"kinetic_n_mm_per_mm": 0.001},
    "stribeck_rad_s": {"kinetic_n_mm_per_mm": 0.001, "static_excess_n_mm_per_mm": 0.001},
    "tissue_time_constant_s": {"tissue_stiffness_n_mm_per_rad_per_mm": 0.01},
    "layer_boundary_fraction": {"layer_ratio": 2.0},
    "curvature_phase_deg": {"curvature_n_mm_per_mm": 0.001},
    "offset_free_share": {"inserted_offset_mm": 5.0},
}


@pytest.mark.parametrize(
    "name",
    [f.name for f in fields(RigParameters) if isinstance(f.default, float)],
)
def test_every_parameter_changes_the_needle_or_its_sensors(name):
    about = replace(NOMINAL, **NEEDS.get(name, {}))
    changed = replace(about, **{name: 0.7 * getattr(about, name) or 0.001})
    assert (changed.without_sensors == about.without_sensors) is (name in SENSORS)
    if name == "material_share_growing_depth":
        ready = prepared(trial(turns()))
        deeper = replace(ready, inserted_mm=90 + ready.time_s, free_mm=60 - ready.time_s)
        assert setup(changed, deeper) != setup(about, deeper)
    elif name in SENSORS:
        time = np.linspace(0, 1, 11)
        inputs = Schedule(time_s=time, drive=time, free_mm=time, inserted_mm=time, speed_mm_s=time)
        before, after = (np.concatenate(sensed(r, inputs, time, time)) for r in (about, changed))
        assert not np.array_equal(before, after)
    elif name in INPUTS:
        logged = prepared(trial(turns())).schedule
        assert (driven(about, logged) is logged) is (about == NOMINAL)
        before, after = driven(about, logged), driven(changed, logged)
        assert any(not np.array_equal(getattr(before, c), getattr(after, c)) for c in COLUMNS)
    else:
        assert setup(changed) != setup(about)


def test_what_is_not_a_number_is_a_past_a_clock_a_jump_a_filter_or_a_law():
    others = {f.name for f in fields(RigParameters) if not isinstance(f.default, float)}
    assert others == {"pasts", "clock_starts", "jumps", "smoothed", "free"}


def test_a_trial_sees_its_own_clocks_alone_and_a_needle_none():
    one, other = (ClockStart(trial=name, sensor="tip_angle_deg", before_s=2.0) for name in "ab")
    rig = RigParameters(clock_starts=(one, other))
    assert rig.on_trial("a") == RigParameters(clock_starts=(one,))
    assert rig.without_sensors == RigParameters()


def test_a_trial_sees_its_own_past_alone():
    one, other = Past(trial="one", wound_deg=5.0), Past(trial="other", turned_deg=3.0)
    rig = RigParameters(pasts=(one, other))
    assert rig.past_of("other") == other
    assert rig.past_of("third") == Past(trial="third")
    assert rig.on_trial("one") == RigParameters(pasts=(one,))
    assert rig.on_trial("third") == NOMINAL


def test_two_layers_keep_the_total_damping():
    layers = RigParameters(layer_ratio=3.0, layer_boundary_fraction=0.4).tissue(RIG).layers
    shallow, deep = (layer.interface.viscous_n_mm_s_per_mm for layer in layers)
    assert deep == pytest.approx(3 * shallow)
    assert 0.4 * shallow + 0.6 * deep == pytest.approx(RIG.tissue.damping_n_mm_s_per_mm)


def test_what_is_the_same_in_every_trial_is_made_once():
    ready = prepared(trial(turns()))
    shallower = replace(ready, inserted_mm=ready.inserted_mm - 10.0)
    rig = RigParameters(kinetic_n_mm_per_mm=0.001)
    one, other, another = setup(rig, ready), setup(rig, shallower), setup(NOMINAL, ready)
    assert one.tissue is other.tissue
    assert one.law is other.law
    assert another.tissue != one.tissue
    assert other.inserted_mm == one.inserted_mm - 10.0


def test_a_jump_is_of_its_trial_and_of_its_sensor_alone():
    jump = ReadingJump(trial="one", sensor="tip_angle_deg", time_s=1.0, size=2.0)
    rig = RigParameters(jumps=(jump,))
    assert rig.on_trial("one") is rig
    assert rig.on_trial("two") == NOMINAL
    assert rig.without_sensors == NOMINAL
