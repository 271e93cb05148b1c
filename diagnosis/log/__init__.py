"""Reads `rig-log/1`: the nominal rig and its trials, with errors and warnings."""
