"""Rig logs of the independent rig: drawn effects, motions and sensors, and their ground truth."""
