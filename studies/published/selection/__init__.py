"""Which hypotheses are fitted, and what their fits allow to be concluded."""
