"""Names for free-form curves: the plain law that a curve resembles."""
