"""Searches among three effects, and fits that nobody made, that several tests look at."""

import numpy as np
import pytest
from diagnosis_fixtures import FITTED_SAMPLES, fit_of, log_of, start_of_search

from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection import fitting, screened_fits
from diagnosis.selection.search import search
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

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


class Names(list):
    """Names that were fitted, in order; `allowed`: the costs that they had to come below."""


@pytest.fixture
def made(monkeypatch):
    """Fits that end with the cost that their start says, and the names that were fitted."""
    names, allowed = Names(), []
    names.allowed = allowed

    def fit_effects(_, effects, start=None, enough=np.inf):
        allowed.append(enough)
        names.append(tuple(effects))
        if start is not None and np.isnan(start[0]):
            raise SimulationFailed("lost its numbers")
        cost = FITTED_SAMPLES if start is None else float(start[0])
        white = np.random.default_rng(len(names)).normal(size=FITTED_SAMPLES)
        return fit_of(effects, by_trial=[white * np.sqrt(abs(cost) / float(white @ white))], cost=cost)

    monkeypatch.setattr(fitting, "fit_effects", fit_effects)
    for module in (fitting, screened_fits):
        monkeypatch.setattr(module, "fit_in_turn", fit_effects)
    return names
