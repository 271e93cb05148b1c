"""Engines that compute many tasks: processes of this machine, or a cluster."""
