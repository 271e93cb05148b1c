"""An independent rig: the shaft is a chain of finite volumes, integrated in time with BDF2."""
