"""Parts of a free-form law that a rig has once, and how the parts of two laws make one."""
