"""Fits of free-form laws: what one is, which effects may stand beside it, how it is checked."""
