"""Faults of sensors: outliers, saturated and frozen readings, hum."""
