"""Validation of the diagnosis on rigs that it has never seen.

`rig` is an independent needle that shares no code with `models`, `sim` or `diagnosis`; `logs` writes
its rig logs, with the ground truth stored separately; `score` diagnoses them and compares. Imports
run one way: rig <- logs <- score, and only `score` knows the product.
"""
