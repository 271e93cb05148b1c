"""What the sensors of a rig with given parameters would have read."""
