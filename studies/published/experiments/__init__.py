"""The paper's experiments as inputs of the MuJoCo needle, and the figures that it prints for them."""
