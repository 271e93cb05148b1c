"""Trials that begin twisted or moving."""
