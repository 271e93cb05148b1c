"""The motion of the base, estimated from its readings: gaps, smoothing, interpolation."""
