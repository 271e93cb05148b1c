"""The motion of the base behind its readings: gaps, smoothing, what lies between samples."""
