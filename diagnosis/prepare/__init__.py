"""Prepares a log for replay: gaps, the motion of the base, sensor noise."""
