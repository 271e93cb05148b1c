"""The paper's experiments as inputs of the MuJoCo needle, and the figures it printed of them."""
