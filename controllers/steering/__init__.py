"""Steering a bevel tip by its roll: the planar controller; pose and torsion together."""
