"""Imports a lab's files as a rig-log/1 folder: reads them, drafts a mapping, applies one."""
