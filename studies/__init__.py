"""Studies: the simulation compared with published figures and closed forms; controllers on it."""
