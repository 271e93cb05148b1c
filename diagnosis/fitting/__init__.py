"""Fits of a set of effects to a log, and their analysis: noise floor, held-out trials, projections."""
