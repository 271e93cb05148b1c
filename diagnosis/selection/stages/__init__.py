"""Stages of the search: each takes its state and returns the next."""
