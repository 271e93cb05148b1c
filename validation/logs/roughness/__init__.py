"""Roughness of a lab's sensors: ten ways in which logs are worse than white noise on a uniform grid."""
