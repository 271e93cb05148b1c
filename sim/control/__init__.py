"""Controllers on the MuJoCo needle: the paper's tables, their robustness, and steering."""
