"""Steering a bevel tip by its roll: a planar controller, and estimators of pose and torsion."""
