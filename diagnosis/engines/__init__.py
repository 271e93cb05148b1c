"""Who computes many tasks: processes of this machine, or a cluster."""
