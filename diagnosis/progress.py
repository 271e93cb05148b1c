"""How far a diagnosis is: its stage in words, and an estimate of the time that is left of the whole.

The stages take typical shares of the time. Once some have ended, the pace is known,

    left = elapsed * (shares to come) / (shares that have passed),

and a stage that is skipped counts as passed. It is an estimate: nobody knows beforehand whether pairs of
effects will have to be tried.
"""

_WORDS = {
    "nominal rig": "fitting the nominal rig",
    "stiffness or damping alone": "fitting stiffness or damping alone",
    "single effects": "fitting single effects",
    "finalists": "fitting the best single effects to the whole log",
    "pairs": "fitting pairs",
    "finalists, pairs": "fitting the best pairs to the whole log",
    "effects of the best alone": "fitting the effects of the best pair alone",
    "scatter of the best": "fitting the best again without the prior of its scatter",
    "mesh refinement": "refining the mesh",
    "finer mesh": "refining the mesh",
}


def in_words(stage: str) -> str:
    """A stage as people say what is done in it."""
    return _WORDS.get(stage, stage)
