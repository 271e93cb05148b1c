"""Which modelled effects are most like another one: a draw that these explain is rejected at once."""

NEAREST = {
    "tip_sensor_lag": ("tip_sensor_delay",),
    "damping_gradient": ("layered_tissue", "base_compliance"),
    "friction_ageing": ("stiction", "coulomb_friction"),
    "one_way_friction": ("stiction", "coulomb_friction"),
    "friction_of_depth": ("coulomb_friction", "entry_friction"),
    "axially_relieved_friction": ("coulomb_friction", "speed_dependent_friction"),
    "saturating_damping": ("shear_thinning", "coulomb_friction"),
    "damping_decay": ("damping_error", "shear_thinning"),
    "softening_tissue": ("tissue_viscoelasticity",),
    "stiffening_depth": ("tissue_viscoelasticity",),
    "hardening_tissue": ("tissue_viscoelasticity",),
    "soft_play": ("chuck_backlash", "base_compliance"),
    "permanent_set": ("chuck_backlash", "stiffness_error"),
    "tip_friction": ("coulomb_friction", "tip_drag"),
    "tip_in_fibres": ("needle_curvature",),
    "tip_sensor_play": ("tip_sensor_delay",),
    "one_sided_torque_gain": ("torque_scale", "torque_bias"),
    "stiction": ("coulomb_friction",),
    "drive_friction": ("sheath_friction", "entry_friction"),
    "inserted_offset": ("damping_error", "stiffness_error"),
}
"""Modelled effects that look most like these."""
