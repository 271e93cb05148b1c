"""The library of effects is the vocabulary, each effect in a file of its own name."""

from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, prepared, trial, turns

from diagnosis import effects
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.log.trial import COLUMNS, SENSORS
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL

VOCABULARY = {
    "coulomb_friction": "interface",
    "stiction": "interface",
    "speed_dependent_friction": "interface",
    "shear_thinning": "interface",
    "tissue_viscoelasticity": "tissue",
    "layered_tissue": "tissue",
    "entry_friction": "interface",
    "sheath_friction": "drive",
    "load_dependent_friction": "needle",
    "chuck_backlash": "drive",
    "base_compliance": "drive",
    "tip_drag": "needle",
    "needle_curvature": "needle",
    "stiffness_error": "parameters",
    "damping_error": "parameters",
    "tip_angle_bias": "sensor",
    "tip_angle_scale": "sensor",
    "tip_sensor_delay": "sensor",
    "torque_bias": "sensor",
    "torque_scale": "sensor",
    "torque_sensor_delay": "sensor",
    "base_angle_scale": "sensor",
    "drive_friction": "drive",
    "inserted_offset": "parameters",
}


def test_the_library_is_the_vocabulary():
    assert {name: effect.place.value for name, effect in LIBRARY.items()} == VOCABULARY
    assert {p.value for p in Place} == set(VOCABULARY.values())


def test_every_file_of_the_folder_is_an_effect():
    files = {path.stem for path in Path(effects.__file__).parent.glob("*.py")}
    assert files - {"__init__", "effect"} == set(LIBRARY)


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effect_is_in_the_file_of_its_name(name):
    assert import_module(f"diagnosis.effects.{name}").EFFECT is LIBRARY[name]


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effect_needs_what_a_log_has_and_contains_what_is_in_the_library(name):
    effect = LIBRARY[name]
    assert effect.needs in ("", *COLUMNS)
    assert set(effect.contains) <= set(LIBRARY) - {name}
    assert effect.reported
    starts = {len(p.start) for p in effect.parameters}
    assert len(starts) == 1  # the values of one start stand in the same place of each


CONTAINED = [(name, inner) for name, effect in LIBRARY.items() for inner in effect.contains]


@pytest.mark.parametrize(("name", "inner"), CONTAINED)
def test_a_richer_effect_starts_from_a_simpler_one_within_its_bounds(name, inner):
    effect, simple = LIBRARY[name], LIBRARY[inner]
    for values in zip(*(p.start for p in simple.parameters), strict=True):
        begun = effect.contains[inner](*values)
        assert begun
        for start in begun:
            for parameter, value in zip(effect.parameters, start, strict=True):
                assert parameter.low < value < parameter.high


TORQUE_AT_TIP = "load_dependent_friction"


@pytest.fixture(scope="module")
def sliding():
    """A short trial that slides, with a torque at the tip."""
    ready = prepared(trial(turns(3.0), speed=-1.0))
    return replace(ready, tip_torque_n_mm=0.2 * np.clip(ready.time_s, 0, 1))


def distance(sliding, rig):
    """Largest difference from the nominal rig, in sigma."""
    nominal, other = (predict(RIG, sliding, [one])[0] for one in (NOMINAL, rig))
    return max(np.abs(other[s] - nominal[s]).max() / NOISE[s] for s in SENSORS)


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effect_shows_at_a_start_and_is_gone_where_it_is_neutral(sliding, name):
    effect = LIBRARY[name]
    starts = list(zip(*(p.start for p in effect.parameters), strict=True))
    start = starts[0]
    neutral = [p.towards_neutral(v, 1e-6) for p, v in zip(effect.parameters, start, strict=True)]
    assert max(distance(sliding, effect.apply(NOMINAL, *values)) for values in starts) > 1
    # A millionth of the effect; the slope of the nominal needle in it is not steeper than 100.
    assert distance(sliding, effect.apply(NOMINAL, *neutral)) < 0.01


def test_stiction_whose_static_level_is_the_kinetic_is_nearly_coulomb_friction(sliding):
    """Its corner is rounded, by 3 % of the level."""
    level = 0.001
    stiction = LIBRARY["stiction"].apply(NOMINAL, level, level, 0.05)
    assert stiction.kinetic_n_mm_per_mm == level
    assert stiction.static_excess_n_mm_per_mm < 0.04 * level
    coulomb = LIBRARY["coulomb_friction"].apply(NOMINAL, level)
    found = [predict(RIG, sliding, [one])[0]["base_torque_n_mm"] for one in (stiction, coulomb)]
    assert np.abs(found[0] - found[1]).max() < 0.04 * np.abs(found[1]).max()


SCALES = [name for name, effect in LIBRARY.items() if [p.name for p in effect.parameters] == ["scale"]]


@pytest.mark.parametrize("name", SCALES)
def test_a_scale_multiplies_what_is_there(name):
    twice = LIBRARY[name].apply(LIBRARY[name].apply(NOMINAL, 1.25), 1.5)
    assert twice == LIBRARY[name].apply(NOMINAL, 1.875)
