"""A torque that turns the tip: the known torque of a trial, the other way round."""

import numpy as np
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import VOCABULARY, covered

from diagnosis.freeform.families.in_one_place.turning import families
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
SPEED = 2.0 * np.sin(np.linspace(0, 9, ANGLE.size))
FAMILIES = {family.name: family for family in families(covered(ANGLE, tip=ANGLE, speed=SPEED))}
OVER_TIME = FAMILIES["torque that turns the tip over time"]
TORQUE_N_MM = 0.2


def readings(rig, **columns):
    clean = trial(ANGLE)
    own = Trial(name=clean.name, table=clean.table.assign(speed_mm_s=SPEED, **columns))
    return predict(RIG, prepared(own), [rig])[0]


def test_a_constant_one_is_the_known_torque_that_resists_by_less():
    c = [TORQUE_N_MM, *[0.0] * (len(OVER_TIME.effect.parameters) - 1)]
    _, torque = OVER_TIME.curve(*c)
    np.testing.assert_allclose(torque, torque[0])
    turned = readings(OVER_TIME.effect.apply(NOMINAL, *c))
    known = readings(NOMINAL, tip_torque_n_mm=-torque[0])
    for sensor in SENSORS:
        np.testing.assert_allclose(turned[sensor], known[sensor], atol=1e-9)
        assert np.ptp(turned[sensor] - readings(NOMINAL)[sensor]) > 1e-3


def test_each_depends_on_a_variable_that_the_log_varies():
    assert {f.says for f in FAMILIES.values()} == {"time", "axial_speed"} <= VOCABULARY
    assert [f.says for f in families(covered(ANGLE, tip=ANGLE))] == ["time"]
