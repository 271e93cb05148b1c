"""Searches among three effects that several tests look at."""

import pytest
from diagnosis_fixtures import log_of, start_of_search

from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.search import search
from diagnosis.workers import Workers

EFFECTS = ("coulomb_friction", "tip_drag", "torque_bias")


@pytest.fixture(scope="package")
def dry_start():
    return start_of_search(
        log_of(RigParameters(kinetic_n_mm_per_mm=0.001), speed=-1.0, seconds=8.0), EFFECTS
    )


@pytest.fixture(scope="package")
def still_start():
    return start_of_search(log_of(NOMINAL, speed=-1.0, seed=1), EFFECTS)


@pytest.fixture(scope="package")
def undisturbed(dry_start):
    return search(dry_start, Workers())
