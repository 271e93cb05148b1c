"""Steering on the MuJoCo needle: half turns, the planar controller, a fused estimator."""
