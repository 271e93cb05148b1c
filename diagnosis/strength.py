"""How strongly each of several effects shows in a log."""

import numpy as np

from diagnosis.candidate import Candidate
from diagnosis.coordinates import coordinates_of
from diagnosis.evidence import Evidence
from diagnosis.predict import predicted_residuals


def strongest_first(evidence: Evidence, best: Candidate) -> tuple[str, ...]:
    """The effects that a candidate names, by how far the readings move without each."""
    names = best.named
    if len(names) < 2:
        return names
    strength = {name: _moved(evidence, best, name) for name in names}
    return tuple(sorted(names, key=lambda name: -strength[name]))


def _moved(evidence: Evidence, best: Candidate, name: str) -> float:
    """Sum of squares, over noise, of what an effect adds to the others."""
    fit = best.fit
    kept = [e.name for e in fit.coordinates.all if e.name != name]
    nuisance = [e for e in fit.coordinates.nuisance if e.name != name]
    without = coordinates_of([n for n in best.names if n != name], nuisance)
    rig = without.rig(without.joined({n: fit.parts[n] for n in kept}))
    runs = predicted_residuals(evidence, [rig])
    each = zip(runs, best.fit.by_trial, strict=True)
    return float(sum(np.sum((run[0] - residual) ** 2) for run, residual in each))
