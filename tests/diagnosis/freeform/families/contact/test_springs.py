"""A free law of a spring between shaft and tissue, against the twist of a shaft on an elastic bed.

At rest G J θ'' = k θ along the inserted length L, with a free tip; with λ = sqrt(k / (G J)) and the free
length F in series,

    torque = turn / (F / (G J) + 1 / (G J λ tanh(λ L))).
"""

import math

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered

from diagnosis.freeform.families.contact.springs import families
from diagnosis.log.trial import TORQUE
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from models.tissue import Interface

ANGLE, STIFFNESS, TURN_DEG = turns(6.0), 0.01, 60.0
FREE_MM, INSERTED_MM = 60.0, 90.0
SPRING = next(f for f in families(covered(ANGLE, tip=ANGLE)) if f.says == "time")
SIZE = len(SPRING.effect.parameters) - 1


def torque_n_mm(start_deg=0.0, c=(0.0,) * SIZE):
    """At the base after a turn and a rest of ten seconds, for coordinates of the curve."""
    base = start_deg + np.interp(0.05 * np.arange(260), [0.0, 3.0], [0.0, TURN_DEG])
    own = prepared(trial(base, step=0.05, deep_mm=INSERTED_MM))
    rig = SPRING.effect.apply(NOMINAL, STIFFNESS, *c)
    (prediction,) = predict(RIG, own, [rig])
    return prediction[TORQUE][-1]


def on_elastic_bed_n_mm(stiffness):
    rigidity = RIG.rigidity_n_mm2
    rate = math.sqrt(stiffness / rigidity)
    compliance = FREE_MM / rigidity + 1.0 / (rigidity * rate * math.tanh(rate * INSERTED_MM))
    return math.radians(TURN_DEG) / compliance


def test_a_base_that_hardly_turns_has_no_such_law():
    assert families(covered(0.001 * ANGLE, tip=ANGLE)) == ()


def test_at_rest_the_torque_is_that_of_a_shaft_on_an_elastic_bed():
    """To 1 %, by which the slow wave is bent; the tip turns by less."""
    expected = on_elastic_bed_n_mm(STIFFNESS)
    assert torque_n_mm() == pytest.approx(expected, rel=0.01)


def test_angles_are_from_where_a_trial_starts():
    assert torque_n_mm(start_deg=200.0) == pytest.approx(torque_n_mm(), rel=1e-4)


def test_a_spring_that_is_softer_in_the_end_has_the_torque_of_that():
    places, factors = SPRING.curve(STIFFNESS, 0.0, -1.0, *(0.0,) * (SIZE - 2))
    assert np.ptp(places) > 0
    softer = torque_n_mm(c=(0.0, -1.0, *(0.0,) * (SIZE - 2)))
    assert softer == pytest.approx(on_elastic_bed_n_mm(factors[-1]), rel=0.01)
    assert factors[-1] == pytest.approx(STIFFNESS * math.exp(-1.0))


def test_a_law_of_the_angle_beside_it_is_not_from_the_start():
    """A bent shaft prefers an angle of its own, wherever a trial starts."""
    spring = SPRING.effect.apply(NOMINAL, STIFFNESS, *(0.0,) * SIZE).free
    bent = Interface(orientation_n_mm_per_mm=0.001, orientation_phase_deg=30.0)
    begun = spring.beside(FreeLaw(throughout=(bent,))).begun_at(0.0, 200.0, 0.0)
    one, other = begun.throughout
    assert one == bent
    assert other.orientation_phase_deg == pytest.approx(200.0 * other.orientation_cycles)
    assert begun.begun_at(0.0, 90.0, 0.0) == begun
