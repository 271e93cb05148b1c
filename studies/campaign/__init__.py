"""Campaigns: sweeps and Monte-Carlo insertions, control runs or diagnoses from one YAML file."""
