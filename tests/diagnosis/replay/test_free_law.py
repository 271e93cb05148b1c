"""A free-form law in a rig."""

import numpy as np
import pytest

from diagnosis.replay.free_law import ActsOn, Curve, FreeLaw
from diagnosis.replay.variables import Variable
from models.errors import InvalidValue
from models.tissue import Interface, Layer, Tissue
from sim.schedule import Schedule

TIME = np.arange(0, 10, 0.01)
TIP, TORQUE = 20.0 * np.sin(TIME), 0.1 * np.cos(TIME)
PLACES, VALUES = (0.0, 2.0, 3.0, 8.0), (1.0, 1.0, 4.0, 2.0)
READ = (ActsOn.DRIVE_TORQUE, ActsOn.TIP_READING, ActsOn.TORQUE_READING)
LAYER = Interface(viscous_n_mm_s_per_mm=0.02, kinetic_n_mm_per_mm=0.001)


def curve(acts_on=ActsOn.TIP_READING, variable=Variable.TIME, places=PLACES, values=VALUES, **more):
    return Curve(acts_on=acts_on, variable=variable, places=places, values=values, **more)


def inputs():
    return Schedule(
        time_s=TIME,
        drive=30.0 * TIME,
        free_mm=np.full(TIME.size, 60.0),
        inserted_mm=np.full(TIME.size, 90.0),
        speed_mm_s=np.zeros(TIME.size),
    )


def test_a_curve_goes_through_its_points_and_is_level_beyond_them():
    own = curve()
    np.testing.assert_allclose(own.at(np.array(PLACES)), VALUES)
    np.testing.assert_allclose(own.at(np.array([-5.0, 50.0])), [1.0, 2.0])


def test_between_its_points_a_curve_does_not_overshoot():
    """Fritsch and Carlson: monotone between points, so that a factor stays positive."""
    own = curve().at(np.linspace(0, 8, 400))
    assert own.min() >= 1.0
    assert own.max() <= 4.0
    np.testing.assert_allclose(curve().at(np.linspace(0, 2, 50)), 1.0)


def test_two_points_are_a_straight_line():
    line = curve(places=(1.0, 3.0), values=(5.0, 9.0))
    np.testing.assert_allclose(line.at(np.array([1.5, 2.0, 2.75])), [6.0, 7.0, 8.5])


def test_a_sine_through_five_places_is_a_sine():
    """The error of a cubic spline is of fourth order in the places: (2 pi / 5)^4 / 384 = 0.6 %."""
    places = np.arange(5) * 36.0
    own = curve(places=tuple(places), values=tuple(np.sin(np.radians(2 * places + 20))), period=180.0)
    x = np.linspace(-300, 300, 400)
    np.testing.assert_allclose(own.at(x), np.sin(np.radians(2 * x + 20)), rtol=0, atol=0.01)


def test_a_periodic_curve_repeats_without_a_jump():
    own = curve(places=(0.0, 30.0, 60.0), values=(1.0, -2.0, 0.5), period=90.0)
    x = np.linspace(-400, 400, 333)
    np.testing.assert_allclose(own.at(x + 90.0), own.at(x), atol=1e-9)
    np.testing.assert_allclose(own.at(np.array([-90.0, 30.0, 150.0])), [1.0, -2.0, 0.5], atol=1e-9)
    assert own.at(np.array([90.0 - 1e-6]))[0] == pytest.approx(1.0, abs=1e-4)


def test_a_reading_of_the_past_alone_follows_a_step_as_a_filter_of_first_order():
    own = curve(variable=Variable.PAST, places=(0.5, 1.0), values=(1.0, 0.0))
    step = np.where(TIME > 2.0, 10.0, 0.0)
    since_s = np.maximum(TIME - 2.0, 0.0)
    expected = 10.0 * (1.0 - np.exp(-since_s / 0.5))
    # The step takes one sample: half of it is a delay.
    np.testing.assert_allclose(step + own.of_past(TIME, step), expected, atol=10.0 * 0.01 / 0.5)


def test_a_ramp_lags_by_the_shares_of_the_past_times_their_time_constants():
    own = curve(variable=Variable.PAST, places=(0.1, 0.3), values=(0.4, 0.5))
    lag = -own.of_past(TIME, 7.0 * TIME)[-1] / 7.0
    assert lag == pytest.approx(0.4 * 0.1 + 0.5 * 0.3, rel=0.01)


def test_a_trial_sees_what_is_of_all_trials_and_of_itself():
    every, own, other = curve(), curve(trial="a.csv"), curve(trial="b.csv")
    law = FreeLaw(curves=(every, own, other), asymmetry=0.3)
    assert law.on_trial("a.csv") == FreeLaw(curves=(every, own), asymmetry=0.3)


def test_the_needle_feels_tissue_and_drive_angle_alone():
    curves = {acts_on: curve(acts_on) for acts_on in ActsOn}
    felt = FreeLaw(curves=tuple(curves.values()), asymmetry=0.2).without_sensors()
    assert felt == FreeLaw(curves=tuple(curves[own] for own in ActsOn if own not in READ), asymmetry=0.2)


def test_what_is_done_to_the_needle_is_the_drive_and_the_curve():
    shifted = FreeLaw(curves=(curve(ActsOn.DRIVE_ANGLE),)).driven(inputs(), 0.0, TORQUE)
    np.testing.assert_allclose(shifted.drive, inputs().drive + curve().at(TIME))
    np.testing.assert_array_equal(shifted.tissue_factor, 1.0)


def test_factors_of_the_tissue_multiply_and_stay_positive():
    law = FreeLaw(curves=(curve(ActsOn.TISSUE), curve(ActsOn.TISSUE)), tissue_varies=True)
    done = law.driven(inputs(), 0.0, TORQUE)
    np.testing.assert_allclose(done.tissue_factor, curve().at(TIME) ** 2)
    np.testing.assert_array_equal(done.drive, inputs().drive)
    small = FreeLaw(curves=(curve(ActsOn.TISSUE, values=(1e-9,) * 4),)).driven(inputs(), 0.0, TORQUE)
    assert small.tissue_factor.min() == pytest.approx(1e-3)
    with pytest.raises(InvalidValue, match="factors above 0"):
        curve(ActsOn.TISSUE, values=(-1.0,) * 4)


def test_sensors_read_their_own_curves():
    law = FreeLaw(
        curves=(
            curve(ActsOn.TIP_READING),
            curve(ActsOn.TORQUE_READING, Variable.TORQUE, (-0.1, 0.1), (-0.2, 0.2)),
            curve(ActsOn.DRIVE_TORQUE, Variable.BASE_ANGLE, (0.0, 300.0), (0.0, 3.0)),
            curve(ActsOn.TISSUE),
        )
    )
    tip, torque = law.sensed(inputs(), 0.0, TIP, TORQUE)
    np.testing.assert_allclose(tip, curve().at(TIME))
    np.testing.assert_allclose(torque, 2.0 * TORQUE + 0.01 * inputs().drive, atol=1e-9)


def test_a_law_of_nothing_changes_nothing():
    tissue = Tissue(layers=(Layer(interface=LAYER),), entry_friction_n_mm=0.2)
    done = FreeLaw().driven(inputs(), 0.0, TORQUE)
    np.testing.assert_array_equal(done.drive, inputs().drive)
    assert not any(read.any() for read in FreeLaw().sensed(inputs(), 0.0, TIP, TORQUE))
    assert FreeLaw().tissue(tissue) == tissue
    assert FreeLaw().more_rows == 0


def test_the_law_is_in_every_layer_and_further_laws_beside():
    dry = Interface(kinetic_n_mm_per_mm=0.002)
    two = Tissue(layers=(Layer(interface=LAYER, fraction=0.4), Layer(interface=LAYER)))
    law = FreeLaw(asymmetry=0.3, tissue_varies=True, throughout=(dry,), at_tip=(dry, dry))
    found = law.tissue(two)
    assert [layer.interface.asymmetry for layer in found.layers] == [0.3, 0.3]
    assert all(layer.interface.varies for layer in found.layers)
    assert (found.throughout, found.at_tip, law.more_rows) == ((dry,), (dry, dry), 3)


def test_a_curve_over_the_rate_is_in_the_tissue():
    factors = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4)
    law = FreeLaw(rate_curve=factors, rate_range_rad_s=(0.02, 3.0))
    (layer,) = law.tissue(Tissue(layers=(Layer(interface=LAYER),))).layers
    assert (layer.interface.rate_curve, layer.interface.rate_range_rad_s) == (factors, (0.02, 3.0))


@pytest.mark.parametrize("acts_on", [ActsOn.DRIVE_ANGLE, ActsOn.TISSUE, ActsOn.TIP_READING])
@pytest.mark.parametrize("variable", [Variable.TORQUE, Variable.TIME])
def test_only_a_curve_of_the_needle_over_the_torque_follows_it(acts_on, variable):
    law = FreeLaw(curves=(curve(acts_on, variable, values=(1.0, 2.0, 1.0, 2.0)),))
    of_needle = acts_on is not ActsOn.TIP_READING
    assert law.follows_torque == (of_needle and variable is Variable.TORQUE)
