"""What real rigs also do and the diagnosis does not model, by the place where it acts.

Each effect has a law, in the docstring of its function, and parameters, of which one, its strength, may
be made as small as one likes. None is exactly a modelled effect, but weak ones may look much like one.
Beside each stands what a diagnosis should say of it: where it acts, and what it depends on.
"""
