"""Mechanisms that may explain the residual."""

from diagnosis.effects import LIBRARY
from studies.published.experiments.base_turn import BaseTurn, BaseTurnShape
from studies.published.experiments.rig import PublishedRig
from studies.published.fitting.mechanisms import (
    BASE_RAMP,
    BASE_SERVO,
    DAMPING,
    FREE_LENGTH,
    NOT_STUDIED,
    OF_GELATIN,
    OF_PLASTISOL,
)


def test_every_effect_of_the_library_that_the_figures_can_show_is_a_mechanism():
    assert set(LIBRARY) > NOT_STUDIED
    assert set(OF_GELATIN) == set(LIBRARY) - NOT_STUDIED
    assert set(OF_PLASTISOL) | {DAMPING.name} == (set(LIBRARY) - NOT_STUDIED) | {
        "free_length",
        "base_ramp",
        "base_servo",
    }


def test_the_rigs_own_mechanisms_change_damping_free_length_and_base_motion():
    rig = PublishedRig()
    assert DAMPING.apply(DAMPING.apply(rig, 0.5), 0.5).model.damping_scale == 0.25
    assert FREE_LENGTH.apply(rig, 15.0).free_mm == 15.0
    assert BASE_RAMP.apply(rig, 0.2).turn == BaseTurn(time_s=0.2)
    assert BASE_SERVO.apply(rig, 0.1).turn == BaseTurn(shape=BaseTurnShape.SERVO, time_s=0.1)


def test_a_single_parameter_of_either_sign_starts_from_both_and_from_zero():
    (bias,) = OF_PLASTISOL["tip_angle_bias"].parameters
    assert 0.0 in bias.start
    assert set(bias.start) == {-s for s in bias.start}
