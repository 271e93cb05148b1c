"""Residuals, measured minus predicted: by part, over frequency and over time."""
