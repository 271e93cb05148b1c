"""A lab's files as a rig-log/1 folder: reading them, guessing a mapping, applying one."""
