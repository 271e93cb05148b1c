"""The noise of a sensor from the spectrum of residuals of its readings."""
