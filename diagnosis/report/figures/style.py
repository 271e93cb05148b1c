"""What the pictures of a report have in common: colours of the predictions, names of the sensors."""

MEASURED = "0.6"
PREDICTIONS = {"nominal": "tab:blue", "explained": "tab:red"}
LABELS = {"tip_angle_deg": "tip, deg", "base_torque_n_mm": "base torque, N mm"}
