"""From a rig's log to what the model lacks."""
