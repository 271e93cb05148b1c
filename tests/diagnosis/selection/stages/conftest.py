"""Stages that only say what they would fit."""

import pytest

from diagnosis.selection import candidate, fitting
from diagnosis.selection.stages import best


@pytest.fixture
def asked(monkeypatch):
    """Sets of effects that are fitted; fits that are scores alone have no trials to leave out."""
    found = []
    monkeypatch.setattr(candidate, "held_out_or_refitted", lambda _, fit: fit.by_trial)
    monkeypatch.setattr(candidate, "unresolved_law_cost", lambda *_: 0.0)

    def fit_all(stage, calls, workers):
        found.extend(call[1] for call in calls)
        return [], ()

    for owner in (best, fitting):
        monkeypatch.setattr(owner, "fit_all", fit_all)
    return found
