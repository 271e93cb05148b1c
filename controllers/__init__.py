"""Estimating and controlling the tip from the base. Runs on a rig: no simulator here."""
