"""What several tests share."""

import os

os.environ.setdefault("CI", "1")  # rerun collects nothing
os.environ.setdefault("MPLBACKEND", "Agg")
