"""Checks of a log that has been read: signs, units, lengths, repeats."""
