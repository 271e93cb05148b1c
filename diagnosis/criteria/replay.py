"""How fine a replay has to be (replay/, selection/stages/mesh_refinement.py)."""

REFINE_SIGMA = 0.1
"""A finer replay matters if it changes a trial by so much of sigma, which makes 1.12 of the slow part,
whose limit is 1.25. Set on seed 10."""
REFINE_SHARE = 0.25
"""And by this share of the sum of squares beyond noise. Set on seed 10."""
DECIMATION_SIGMA = 0.5
"""By how much of the noise the nominal rig on the decimated log may differ from that on the log. Usual
logs: 0.05 to 0.45; set on a rig with turns of several hertz and little noise, 0.9 to 3.4, where two
causes were missed for it, and where windows half as long are off by 0.2 to 0.5."""
LONG_LOG_S = 150.0
"""Length of a log, all trials together, above which windows are up to twice as long: a choice that saves
time, as such a log has readings to spare."""
WIDE_SIGMA = 0.25
"""By how much of the noise the coarse needle may differ there: half of DECIMATION_SIGMA."""
FINEST_ELEMENTS = 48
"""Elements of the inserted needle, at most. A choice that limits time."""
FINEST_STEP_S = 0.0025
"""Step of a replay, at least. The same."""
NUMERICAL_ERROR_WARNED = 0.14
"""Derived: numerical error of so much of sigma adds 1 % to a gap at the floor."""
