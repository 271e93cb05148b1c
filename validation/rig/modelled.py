"""Effects that the diagnosis models: where their parameters go in the laws and sensors of this rig."""

from collections.abc import Mapping

Effects = Mapping[str, Mapping[str, float]]
"""Effect -> parameter -> value, units as in the reports."""

LAW_FIELDS: dict[str, dict[str, str]] = {
    "coulomb_friction": {"level": "coulomb"},
    "stiction": {"kinetic": "kinetic", "static": "static", "stribeck": "stribeck"},
    "speed_dependent_friction": {"level": "shared"},
    "shear_thinning": {"exponent": "exponent"},
    "tissue_viscoelasticity": {"stiffness": "compliance", "time_constant": "retardation"},
    "layered_tissue": {"ratio": "ratio", "boundary": "boundary"},
    "entry_friction": {"level": "entry"},
    "sheath_friction": {"level": "sheath"},
    "load_dependent_friction": {"coefficient": "load"},
    "chuck_backlash": {"gap": "half_gap"},
    "base_compliance": {"stiffness": "base_compliance"},
    "tip_drag": {"damping": "tip_drag"},
    "needle_curvature": {"torque": "curvature", "phase": "phase"},
    "stiffness_error": {"scale": "rigidity"},
    "damping_error": {"scale": "damping"},
}
"""Field of `LawParameters` for every parameter of the effects of the machine."""

SENSOR_FIELDS: dict[str, dict[str, float]] = {
    "tip_angle_bias": {"bias": 0.0},
    "tip_angle_scale": {"scale": 1.0},
    "tip_sensor_delay": {"delay": 0.0},
    "torque_bias": {"bias": 0.0},
}
"""Parameters of the effects of sensors, and their neutral values."""

MODELLED = (*LAW_FIELDS, *SENSOR_FIELDS)

WRONG_CONSTANT_FIELDS: dict[str, dict[str, float]] = {
    "torque_scale": {"scale": 1.0},
    "torque_sensor_delay": {"delay": 0.0},
    "base_angle_scale": {"scale": 1.0},
    "drive_friction": {"level": 0.0},
    "inserted_offset": {"offset": 0.0},
}
"""Parameters of the effects that came later, and their neutral values."""

WRONG_CONSTANTS = tuple(WRONG_CONSTANT_FIELDS)
"""Modelled too, but not drawn unless they are asked for: sets of logs keep their bytes."""
