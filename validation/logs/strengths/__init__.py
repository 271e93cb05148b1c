"""How the strengths of effects are drawn: a family of parameters for each, modelled or not."""
