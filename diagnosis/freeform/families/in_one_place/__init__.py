"""Free laws of what resists the shaft in one place: at the tip, where it enters, or in its sheath."""
