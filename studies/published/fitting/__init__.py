"""Hypotheses about the published rig, and their fits to the published figures."""
