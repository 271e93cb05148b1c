"""One implicit stage of a step: its equation, assembled, and Newton's method on it."""
