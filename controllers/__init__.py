"""Knowing and driving the tip from the base. Runs on a rig: no simulator here."""
