"""An interface that depends on the angle of the shaft: it only takes energy, and is told as it acts."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.shaft.not_round import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
FAMILIES = {family.name: family for family in families(covered(ANGLE, tip=ANGLE))}
UNEVEN, KEYED = FAMILIES


def rig_of(name, *values):
    return FAMILIES[name].effect.apply(NOMINAL, *values)


def test_damping_without_waves_is_the_nominal_one():
    assert same_readings(ANGLE, rig_of(UNEVEN, 0.0, 0.0, 0.0, 0.0), NOMINAL)
    assert not same_readings(ANGLE, rig_of(UNEVEN, 0.0, 0.01, 0.0, 0.0), NOMINAL)


def test_uneven_damping_is_told_as_damping_and_stays_positive():
    beta = covered(ANGLE, tip=ANGLE).damping_n_mm_s_per_mm
    angles, damping = FAMILIES[UNEVEN].curve(0.0, 0.0, 0.3 * beta, 0.2 * beta)
    x = np.radians(angles)
    np.testing.assert_allclose(damping, beta * (1 + 0.3 * np.sin(2 * x) + 0.2 * np.cos(2 * x)))
    _, strong = FAMILIES[UNEVEN].curve(0.0, 3.0 * beta, 0.0, 4.0 * beta)
    assert min(strong) > 0
    laws = rig_of(UNEVEN, 0.0, 0.0, 0.3 * beta, 0.2 * beta).free.throughout
    at = np.radians(30.0)
    told = sum(
        law.orientation_viscous_n_mm_s_per_mm
        * np.cos(law.orientation_cycles * at - np.radians(law.orientation_phase_deg))
        for law in laws
    )
    assert told == pytest.approx(beta * (0.3 * np.sin(2 * at) + 0.2 * np.cos(2 * at)))


def test_friction_over_the_angle_is_a_level_and_what_waves_add_to_it():
    """Never below the level, which it reaches at the easiest angle of a single wave."""
    around = {family.name: family for family in families(covered(3.0 * ANGLE))}
    angles, level = around[KEYED].curve(0.002, 0.0, 0.0, 0.0003, 0.0004)
    x = 2 * np.radians(angles)
    np.testing.assert_allclose(level, 0.0025 + 0.0003 * np.sin(x) + 0.0004 * np.cos(x))
    # Points every 7.5 deg: 15 deg of this wave.
    assert 0.002 <= min(level) < 0.002 + 0.0005 * (1.0 - np.cos(np.radians(7.5)))
    laws = FAMILIES[KEYED].effect.apply(NOMINAL, 0.002, 0.0, 0.0, 0.0003, 0.0004).free.throughout
    at = np.radians(30.0)
    told = sum(
        law.kinetic_n_mm_per_mm
        + law.orientation_dry_n_mm_per_mm
        * (1.0 + np.cos(law.orientation_cycles * at - np.radians(law.orientation_phase_deg)))
        for law in laws
    )
    assert told == pytest.approx(0.0025 + 0.0003 * np.sin(2 * at) + 0.0004 * np.cos(2 * at))


def test_friction_whose_waves_are_none_is_that_of_the_library():
    flat = FAMILIES[KEYED].effect.apply(NOMINAL, 0.001, 0.0, 0.0, 0.0, 0.0)
    dry = LIBRARY["coulomb_friction"].apply(NOMINAL, 0.001)
    assert same_readings(ANGLE, flat, dry)
    wave = FAMILIES[KEYED].effect.apply(NOMINAL, 0.0005, 0.0005, 0.0, 0.0, 0.0)
    assert not same_readings(ANGLE, wave, dry)


def test_a_needle_that_hardly_turns_has_no_law_of_its_angle():
    assert families(covered(0.1 * ANGLE, tip=ANGLE)) == ()
    assert [family.name for family in families(covered(ANGLE, tip=ANGLE))] == [UNEVEN, KEYED]
