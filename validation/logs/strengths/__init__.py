"""How strong effects are drawn: a family of parameters for each, modelled or not."""
