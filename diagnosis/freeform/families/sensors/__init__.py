"""Free-form laws of a sensor by a few numbers."""
