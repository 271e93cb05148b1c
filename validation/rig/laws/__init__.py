"""The laws of the rig: their parameters, and the torques of interface, shaft and tissue."""

from validation.rig.laws.parameters import LawParameters

__all__ = ["LawParameters"]  # caches that numba compiled earlier look for it here
