"""Conversions between the units that people read and SI, which MuJoCo computes in.

N mm, mm, deg, s, GPa, g/cm3 at the edges; N m, m, rad, s, Pa, kg/m3 inside.
"""

import math

MM = 1e-3  # m
N_MM = 1e-3  # N m
N_MM2 = 1e-6  # N m^2
GPA_TO_N_PER_MM2 = 1e3
G_PER_CM3 = 1e3  # kg/m^3
DEG = math.pi / 180.0  # rad
