"""Equivalence: other sets of effects that would have changed the readings of a log in the same way."""
