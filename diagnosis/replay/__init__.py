"""Replay: the readings that a rig with given parameters would have."""
