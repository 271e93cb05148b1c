"""Free laws of what each contact between shaft and tissue has been through."""
