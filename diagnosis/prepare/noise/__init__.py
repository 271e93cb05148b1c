"""Noise of the sensors: its size, its colour, rounding and drift."""
