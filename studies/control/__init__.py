"""Controllers on the MuJoCo needle: Tables IV and V, robustness, and steered insertions."""
