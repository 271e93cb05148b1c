"""Free laws of the shaft's stiffness: where they become one that is stiffer, they are this."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered, same_readings

from diagnosis.freeform.families.shaft.stiffness import families
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.variables import Variable

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE, torque=0.02 * ANGLE, seen=(ANGLE, 0.02 * ANGLE))
FAMILIES = {f.name: f for f in families(RANGES)}
ALONG = FAMILIES["stiffness over position"]


def test_without_a_torque_nothing_is_asked_of_the_shaft():
    assert families(covered(ANGLE, tip=ANGLE)) == ()


@pytest.mark.parametrize(
    "name", ["stiffness over position", "stiffness over torque", "stiffness over time"]
)
def test_a_shaft_that_is_as_much_stiffer_everywhere_is_a_stiffer_one(name):
    family = FAMILIES[name]
    straight = [np.log(1.3), *[0.0] * (len(family.effect.parameters) - 1)]
    stiffer = family.effect.apply(NOMINAL, *straight)
    assert same_readings(ANGLE, stiffer, RigParameters(stiffness_scale=1.3))
    assert not same_readings(ANGLE, stiffer, NOMINAL)


def test_places_along_the_shaft_are_told_from_the_tip_to_the_chuck():
    places, factors = ALONG.curve(*[0.0] * len(ALONG.effect.parameters))
    np.testing.assert_allclose(factors, 1.0)
    assert (min(places), max(places)) == (0.0, 150.0)
    needle = ALONG.effect.apply(NOMINAL, 0.0, 1.0, *[0.0] * 8).needle(RIG)
    first, last = needle.stiffness_factors(np.array([0.0, 150.0]))
    assert first == pytest.approx(np.exp(-1.0))
    assert last == pytest.approx(np.exp(1.0))


def test_a_shaft_that_softens_while_it_relaxes_carries_less_and_relaxes_slower():
    """The slowest mode: torque ~ s(t) exp(-rate * integral of s), once the others have died away."""
    held = np.interp(np.arange(0, 16, 0.01), [0, 0.5, 1.0], [0, 0, 90])
    softens = Curve(
        acts_on=ActsOn.STIFFNESS, variable=Variable.TIME, places=(8.0, 8.001), values=(1.0, 0.6)
    )
    own = prepared(trial(held))
    rigs = [NOMINAL, RigParameters(free=FreeLaw(tissue_varies=True, curves=(softens,)))]
    at = np.rint(100 * np.array([6.0, 7.9, 8.1, 10.0])).astype(int)
    torques = [p.base_torque_n_mm[at] for p in predict(RIG, own, rigs)]
    (nominal, _, _, _), (before, last, first, after) = np.log(torques)
    rate = (before - last) / 1.9
    assert before == pytest.approx(nominal, abs=1e-9)
    assert (first - after) / 1.9 == pytest.approx(0.6 * rate, rel=0.01)
    assert first - last == pytest.approx(np.log(0.6) - rate * (0.1 + 0.06), abs=0.01)
