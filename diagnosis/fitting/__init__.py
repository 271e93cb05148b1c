"""Fitting a set of effects to a log, and what a fit tells: noise floor, held-out trials, projections."""
