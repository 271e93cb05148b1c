"""Conversions between the units of users and SI, in which MuJoCo computes.

Inputs and outputs: N mm, mm, deg, s, GPa, g/cm3. Inside: N m, m, rad, s, Pa, kg/m3.
"""

import math

MM = 1e-3  # m
N_MM = 1e-3  # N m
N_MM2 = 1e-6  # N m^2
GPA_TO_N_PER_MM2 = 1e3
G_PER_CM3 = 1e3  # kg/m^3
DEG = math.pi / 180.0  # rad
