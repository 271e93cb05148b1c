"""Roughness of a lab's sensors: ten ways in which a log is worse than white noise on an even grid."""
