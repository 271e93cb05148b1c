"""What several families of free-form laws have in common: an added curve, a level, a ripple."""
