"""Effects of real rigs that the diagnosis does not model, by the place where they act.

Each effect has a law, in the docstring of its function, and parameters, one of which, its strength, can
be arbitrarily small. None equals a modelled effect, but weak ones may resemble one.
Each also states what a diagnosis should say about it: where it acts, and what it depends on.
"""
