"""Which hypotheses are fitted, and the conclusions that their fits support."""
