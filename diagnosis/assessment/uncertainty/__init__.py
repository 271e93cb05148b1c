"""Covariances and intervals of parameters, and what they leave open."""
