"""Checks of a log that has been read: units, lengths, noise, repeats."""
