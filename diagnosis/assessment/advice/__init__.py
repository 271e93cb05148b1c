"""What to do next: what to change in rig or model, and which run tells most."""
