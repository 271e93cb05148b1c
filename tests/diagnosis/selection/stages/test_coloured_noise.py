"""All begins again where an effect shows noise of another colour."""

from dataclasses import replace

import numpy as np

from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.selection.stages import coloured_noise as module
from diagnosis.workers import Workers


def test_a_search_begins_again_where_the_best_effect_leaves_another_colour(dry_start, monkeypatch):
    """Noise that was taken for coloured beside dry friction, and is white once that is known."""
    sigma = dry_start.problem.noise.sigma
    colour = {"tip_angle_deg": NoiseColour(share=0.5, correlation_time_s=0.1)}
    noise = replace(dry_start.problem.noise, colour=colour)
    start = replace(
        dry_start,
        effects=("coulomb_friction",),
        nominal=rescaled(dry_start.nominal, dry_start.problem, noise),
        problem=replace(dry_start.problem, noise=noise),
        coarse=replace(dry_start.coarse, noise=replace(dry_start.coarse.noise, colour=colour)),
    )
    monkeypatch.setattr(module, "with_colour", lambda problem, _: replace(problem.noise, colour={}))
    begun = module.single_effects(module.nominal_rig(start, Workers()), Workers())
    again = module.coloured_noise(begun, Workers())
    assert again.problem.noise.colour == again.coarse.noise.colour == {}
    assert again.problem.noise.sigma == sigma
    np.testing.assert_allclose(again.nominal.by_trial[0], dry_start.nominal.by_trial[0], atol=1e-9)
    dropped = [e for e in again.record if e.stage == "coloured noise"]
    assert [e.effects for e in dropped] == [c.names for c in begun.candidates]
    # Where the colours are the same, nothing is done.
    assert module.coloured_noise(again, Workers()) is again
