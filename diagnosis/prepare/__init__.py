"""From what a rig logged to what a replay needs: gaps, the motion of the base, sensor noise."""
