"""Studies: the simulation beside published figures, closed forms and controllers."""
