"""Computing time of the simulator, and of other programs. One thread each, also for BLAS."""

import os

for _library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")
