"""Guesses what a lab's columns are: each with its reason, and none used before it is confirmed."""
