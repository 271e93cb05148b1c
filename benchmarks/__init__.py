"""What the simulator costs, beside what others cost. One thread each: BLAS too."""

import os

for _library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")
