"""A free-form law in a rig."""

from dataclasses import replace

import numpy as np
import pytest

from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.variables import Variable
from models.errors import InvalidValue
from models.kerf import Kerf
from models.tissue import RATE_POINTS, Interface, Layer, Tissue
from sim.schedule import Schedule

TIME = np.arange(0, 10, 0.01)
TIP, TORQUE = 20.0 * np.sin(TIME), 0.1 * np.cos(TIME)
PLACES, VALUES = (0.0, 2.0, 3.0, 8.0), (1.0, 1.0, 4.0, 2.0)
READ = (
    ActsOn.DRIVE_TORQUE,
    ActsOn.TIP_READING,
    ActsOn.TIP_COUNTS,
    ActsOn.TORQUE_READING,
    ActsOn.TIP_GAIN,
    ActsOn.TORQUE_GAIN,
)
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


def test_a_trial_sees_what_is_of_all_trials_and_of_itself():
    every, own, other = curve(), curve(trial="a.csv"), curve(trial="b.csv")
    law = FreeLaw(curves=(every, own, other), asymmetry=0.3)
    assert law.on_trial("a.csv") == FreeLaw(curves=(every, own), asymmetry=0.3)


def test_two_laws_at_once_add_their_readings_and_multiply_their_factors():
    tip, torque = FreeLaw(curves=(curve(),)), FreeLaw(curves=(curve(ActsOn.TORQUE_READING),))
    again = FreeLaw(curves=(curve(values=(0.5, 0.2, 0.1, 0.3)),))
    read = [law.sensed(inputs(), 0.0, TIP, TORQUE) for law in (tip, torque, again)]
    together = tip.beside(torque).beside(again).sensed(inputs(), 0.0, TIP, TORQUE)
    for i in (0, 1):
        np.testing.assert_allclose(together[i], sum(own[i] for own in read))
    soft, grown = (
        FreeLaw(curves=(curve(ActsOn.TISSUE, values=values),), tissue_varies=True)
        for values in (VALUES, (0.5, 2.0, 1.0, 3.0))
    )
    factors = [law.driven(inputs(), 0.0, TORQUE).tissue_factor for law in (soft, grown)]
    together = soft.beside(grown).driven(inputs(), 0.0, TORQUE).tissue_factor
    np.testing.assert_allclose(together, factors[0] * factors[1])


def test_beside_no_law_a_law_is_itself():
    law = FreeLaw(
        asymmetry=0.3, shaft=FreeShaft(creep_ratio=0.1), throughout=(LAYER,), tissue_varies=True
    )
    assert law.beside(FreeLaw()) == FreeLaw().beside(law) == law
    assert law.beside(replace(law, throughout=())) == law  # what both set alike is no contradiction


def test_laws_that_set_the_same_part_are_refused():
    with pytest.raises(InvalidValue, match="asymmetry"):
        FreeLaw(asymmetry=0.3).beside(FreeLaw(asymmetry=0.2))


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
    factors = tuple(1.0 - 0.04 * i for i in range(RATE_POINTS))
    law = FreeLaw(rate_curve=factors, rate_range_rad_s=(0.02, 3.0))
    (layer,) = law.tissue(Tissue(layers=(Layer(interface=LAYER),))).layers
    assert (layer.interface.rate_curve, layer.interface.rate_range_rad_s) == (factors, (0.02, 3.0))


@pytest.mark.parametrize("acts_on", [ActsOn.DRIVE_ANGLE, ActsOn.TISSUE, ActsOn.TIP_READING])
@pytest.mark.parametrize("variable", [Variable.TORQUE, Variable.TIME])
def test_only_a_curve_of_the_needle_over_the_torque_follows_it(acts_on, variable):
    law = FreeLaw(curves=(curve(acts_on, variable, values=(1.0, 2.0, 1.0, 2.0)),))
    of_needle = acts_on is not ActsOn.TIP_READING
    assert law.follows_torque == (of_needle and variable is Variable.TORQUE)


def test_a_drive_that_creeps_lags_behind_by_what_the_torque_has_done_so_far():
    own = curve(ActsOn.DRIVE_ANGLE, Variable.PAST, (0.5, 1.0), (-3.0, 0.0))
    law = FreeLaw(curves=(own,))
    assert law.follows_torque
    held = np.full(TIME.size, 0.2)
    held[0] = 0.0
    found = law.driven(inputs(), 0.0, held).drive - inputs().drive
    np.testing.assert_allclose(found, own.creep(TIME, held))
    assert found[-1] == pytest.approx(-0.6)


def test_friction_that_builds_up_in_the_drive_over_its_turn_is_read_as_torque():
    own = curve(ActsOn.DRIVE_TORQUE, Variable.TURNED_BY, (50.0, 100.0), (0.01, 0.0))
    tip, torque = FreeLaw(curves=(own,)).sensed(inputs(), 0.0, TIP, TORQUE)
    np.testing.assert_array_equal(tip, 0.0)
    np.testing.assert_allclose(torque, 0.01 * np.minimum(inputs().drive, 50.0), atol=1e-9)


def test_a_kerf_gets_stronger_and_is_gone_at_no_strength():
    law = FreeLaw(kerfs=(Kerf(torque_n_mm=0.2, travel_mm=5.0),))
    assert [kerf.torque_n_mm for kerf in law.times(0.5).kerfs] == [0.1]
    assert law.times(0.0).kerfs == ()
    assert law.tissue(Tissue(layers=(Layer(interface=LAYER),))).kerfs == law.kerfs
    assert law.more_rows == 1
