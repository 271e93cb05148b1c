"""The score of the diagnosis on logs whose ground truth is known: accuracy and calibration."""
