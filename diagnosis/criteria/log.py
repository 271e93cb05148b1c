"""Reading a log: what is refused, time stamps that jitter, samples taken unevenly (log/)."""

# Reading a log: what is refused (log/)

NOMINAL_RANGE = {
    ("needle", "diameter_mm"): (0.05, 100.0),
    ("needle", "shear_modulus_gpa"): (1e-7, 1000.0),
    ("needle", "density_g_cm3"): (0.1, 1e9),
    ("tissue", "damping_n_mm_s_per_mm"): (1e-8, 10.0),
    ("sensors", "tip_angle_noise_deg"): (0.0, 90.0),
    ("sensors", "base_angle_noise_deg"): (0.0, 90.0),
    ("sensors", "base_torque_noise_n_mm"): (0.0, 100.0),
}
"""Physical: beyond these a constant of rig.yaml is in another unit. Other machines than needles are in
it as an equivalent shaft, which may be thick, soft and heavy."""
MATERIALS_KG_M3 = (500.0, 25_000.0)
"""Physical: densities of materials, from wood to osmium, in another unit."""
LEAST_MATERIAL_GPA = 0.1
"""Physical: shear moduli of the materials of shafts, from plastics on; others are softer."""
READING_RANGE = {
    "time_s": (-1e11, 1e11),
    "base_angle_deg": (-1e5, 1e5),
    "tip_angle_deg": (-1e5, 1e5),
    "base_torque_n_mm": (-1e4, 1e4),
    "tip_torque_n_mm": (-1e4, 1e4),
    "inserted_mm": (-1e-6, 5000.0),
    "free_mm": (-1e-6, 5000.0),
    "speed_mm_s": (-1000.0, 1000.0),
}
"""Physical: beyond these a reading is in another unit, or a sentinel for a missing value."""
FEWEST_ROWS = 20
"""Rows of one trial at least. A choice."""
MOST_ROWS = 2_000_000
"""Rows of all trials together at most: hours at 100 Hz. A choice."""
MOST_BYTES_PER_ROW = 250
"""Bytes of a row at most. A choice, far above eight numbers of 17 digits."""
MOST_LOST_ROWS = 100_000
"""Physical: rows that one pause may be long (1000 s at 100 Hz), since they are replayed as if they were
there; a needle has forgotten by then all but what dry friction holds. A longer one ends a trial."""
LONGEST_SAMPLE_S = 5.0
"""Physical: a needle relaxes within seconds; rarer samples tell nothing, and may be in milliseconds."""
SHORTEST_SAMPLE_S = 1e-5
"""Physical: nobody reads an encoder of a needle more than 100 000 times a second: another unit."""
LEAST_DEPTH_MM = 1.0
"""Physical: all but a needle of more than a metre, told in metres, is below this."""
SHORTEST_SHAFT_DIAMETERS = 3.0
"""Physical: a shaft is longer than this, unless in metres; needles have 50 to 500 diameters."""
SHORTEST_SHAFT_MM = 30.0
"""Physical: or it is longer than this, where a machine is told as a thick one."""
LENGTH_JUMP_MM = 5.0
"""Physical: what a length may change by between two samples, beside its travel in a hold."""
LENGTH_HOLD_S = 1.0
"""Physical: the longest hold of a reading in which it may have travelled."""
WRAP_PERIODS_DEG = (360.0, 180.0)
"""Derived: the periods of an angle that wraps."""
WRAP_REMAINDER = 1 / 6
"""Share of a period by which motion may change the jump of a wrap. A choice."""
WRAP_MOTION_SIGMA = 6.0
"""Standard deviations by which the motion on both sides of a wrap is certain. A choice."""
WRAP_FLICKERS = 3
"""Returns in a row that are a wrap in noise, and no lone spike. A choice."""
WRAP_HELD = 1 / 36
"""Share of a period by which noise may change these while the angle holds: 10 deg of a turn, which are
seven sigma of 1 deg."""
NAME_LIKENESS = 0.75
"""Likeness, 0 to 1, from which a name is taken for a misspelling of another. Set on the spellings in
tests/diagnosis/log/test_unit_hints.py; it decides on the wording of an error alone."""

SAME_STEP = 0.02
"""Relative difference between the steps of trials up to which they are the same."""

# Time stamps that jitter (log/times/even_times.py)

EVEN_MOST_STEPS = 1.0
"""Steps by which stamps may be off an even grid, root mean square: beyond, the grid has lost count."""
EVEN_TELLING_SIGMA = 3.0
"""Derived: a sample tells which axis is the true one where both disagree by three of their standard
deviations."""
EVEN_SIGMA = 6.0
"""Derived: samples have to tell for even times by six standard deviations of a fair coin, once in 10^9
logs."""

# Samples taken unevenly under even stamps (log/times/sampling_jitter.py)

JITTER_CERTAIN_SIGMA = 10.0
"""Certainty with which the scatter of the base grows with its rate: root of twice the log-likelihood.
Six logs of the third rig with such a jitter: 17 to 90; 58 without: at most 9."""
JITTER_MOST_ALIKE = 0.2
"""Correlation from sample to sample that is none of jitter. In the same logs: -0.15 to 0.03, and 0.9."""
JITTER_MOST_BEYOND = 0.03
"""Share of samples beyond four sigma. In the same logs: at most 0.008, and 0.005; of pulses of an exact
base 0.08."""
JITTER_LEAST_STEPS = 0.02
"""Steps that jitter is at least. In the same logs with it: 0.08 to 0.27."""
JITTER_MOST_STEPS = 0.45
"""Steps that it is at most: under half a step samples keep their order."""
